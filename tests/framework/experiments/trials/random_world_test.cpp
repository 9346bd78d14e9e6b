#include "framework/experiments/trials/random_world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "framework/files/world_file.hpp"
#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

std::vector<LandmarkShape> shapes() {
  return {{"circle", Contour::circle(0.5)}, {"square", Contour::polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}})}};
}

World loaded(const std::string& text) {
  const config_test::TestFolder folder;
  return load_world(folder.write("world.yaml", text), shapes());
}

TEST(RandomWorld, LoadsAndKeepsItsGapsOnEverySeed) {
  const RandomWorldConfig config;
  std::set<std::string> categories;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const World world = loaded(random_world_yaml(config, shapes(), 0.3, seed));
    int landmarks = 0;
    for (std::size_t i = 0; i < world.objects.size(); ++i) {
      const WorldObject& a = world.objects[i];
      const Point at_m = a.T_map_object.position();
      const double radius_m = 0.5 * a.contour.outer_diameter_m();
      categories.insert(a.category);
      landmarks += a.category.empty() ? 0 : 1;
      if (!a.category.empty()) {
        EXPECT_NEAR(radius_m, a.category == "circle" ? 0.25 : 0.3536, 0.0361);
      }
      EXPECT_GT((at_m - config.start_m).norm(), radius_m + config.start_gap_m - 1e-3);
      EXPECT_GT((at_m - world.min_m).minCoeff(), radius_m + config.gap_m - 2e-3);
      EXPECT_GT((world.max_m - at_m).minCoeff(), radius_m + config.gap_m - 2e-3);
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GT((at_m - world.objects[k].T_map_object.position()).norm(),
                  radius_m + 0.5 * world.objects[k].contour.outer_diameter_m() + config.gap_m - 3e-3)
            << "seed " << seed;
    }
    EXPECT_GE(landmarks, config.min_landmarks);
    EXPECT_LE(landmarks, config.max_landmarks);
  }
  EXPECT_THAT(categories, testing::ElementsAre("", "circle", "square"));
}

TEST(RandomWorld, PutsLandmarksExactlySoFarFromAWall) {
  RandomWorldConfig config;
  config.wall_gap_m = 0.4;
  std::set<int> walls;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const World world = loaded(random_world_yaml(config, shapes(), 0.0, seed));
    for (const WorldObject& object : world.objects) {
      if (object.category.empty()) continue;
      const Point at_m = object.T_map_object.position();
      const double gaps_m[] = {at_m.x() - world.min_m.x(), world.max_m.x() - at_m.x(), at_m.y() - world.min_m.y(),
                               world.max_m.y() - at_m.y()};
      const auto nearest = std::ranges::min_element(gaps_m);
      walls.insert(static_cast<int>(nearest - std::begin(gaps_m)));
      EXPECT_NEAR(*nearest, 0.5 * object.contour.outer_diameter_m() + 0.4, 2e-3) << "seed " << seed;
    }
  }
  EXPECT_EQ(walls.size(), 4U);
}

TEST(RandomWorld, ScalesLandmarksOnly) {
  RandomWorldConfig config;
  config.landmark_scale = 0.5;
  config.size_tolerance_ratio = 0.0;
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    for (const WorldObject& object : loaded(random_world_yaml(config, shapes(), 0.0, seed)).objects) {
      if (object.category != "circle") continue;
      EXPECT_NEAR(object.contour.outer_diameter_m(), 0.25, 1e-6);
    }
}

TEST(RandomWorld, TheSpecularRatioChangesSurfacesOnly) {
  const std::string rough = random_world_yaml({}, shapes(), 0.0, 7);
  const std::string smooth = random_world_yaml({}, shapes(), 1.0, 7);
  EXPECT_THAT(rough, testing::Not(testing::HasSubstr("smooth")));
  EXPECT_EQ(std::regex_replace(smooth, std::regex("smooth"), "rough"), rough);
  EXPECT_NE(random_world_yaml({}, shapes(), 0.0, 8), rough);
}

TEST(RandomWorld, PutsAShelfBesideEachLandmark) {
  RandomWorldConfig config;
  config.shelf_gap_m = 0.1;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const World world = loaded(random_world_yaml(config, shapes(), 0.0, seed));
    const auto is_landmark = [](const WorldObject& object) { return !object.category.empty(); };
    const auto landmarks = std::ranges::count_if(world.objects, is_landmark);
    const std::size_t first_shelf = world.objects.size() - static_cast<std::size_t>(landmarks);
    std::size_t shelf = first_shelf;
    for (std::size_t i = 0; i < first_shelf; ++i) {
      const WorldObject& a = world.objects[i];
      if (!is_landmark(a)) continue;
      const WorldObject& b = world.objects[shelf++];
      const double to_shelf_m = b.contour.signed_distance(inverse(b.T_map_object) * a.T_map_object.position());
      EXPECT_NEAR(to_shelf_m, 0.5 * a.contour.outer_diameter_m() + 0.1, 3e-3) << "seed " << seed;
    }
    EXPECT_EQ(shelf, world.objects.size());
  }
}

TEST(RandomWorld, ChairsStandOnFourLegsClearOfAllElse) {
  RandomWorldConfig config;
  config.chairs = 3;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const World world = loaded(random_world_yaml(config, shapes(), 0.0, seed));
    const std::size_t things = world.objects.size() - 12;
    for (std::size_t leg = things; leg < world.objects.size(); ++leg) {
      const Point at_m = world.objects[leg].T_map_object.position();
      EXPECT_NEAR(world.objects[leg].contour.outer_diameter_m(), 0.04, 1e-9);
      EXPECT_GT((at_m - config.start_m).norm(), config.start_gap_m);
      for (std::size_t i = 0; i < things; ++i)
        EXPECT_GT((at_m - world.objects[i].T_map_object.position()).norm(),
                  0.5 * world.objects[i].contour.outer_diameter_m() + 0.5)
            << "seed " << seed;
      for (std::size_t other = things; other < leg; ++other)
        EXPECT_GT((at_m - world.objects[other].T_map_object.position()).norm(), 0.39) << "seed " << seed;
    }
  }
}

TEST(RandomWorld, HasAtLeastSoManyMovers) {
  RandomWorldConfig config;
  config.min_movers = 2;
  config.max_movers = 2;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    EXPECT_EQ(loaded(random_world_yaml(config, shapes(), 0.0, seed)).movers.size(), 2U) << "seed " << seed;
}

double distance_to_way(const Point& p, const WorldMover& mover) {
  double nearest_m = 1e9;
  for (int i = 0; i <= 100; ++i)
    nearest_m = std::min(nearest_m, (mover.path_m[0] + 0.01 * i * (mover.path_m[1] - mover.path_m[0]) - p).norm());
  return nearest_m;
}

TEST(RandomWorld, MoversComeToTheSameWorldAndGoClearOfItsThings) {
  RandomWorldConfig config;
  config.max_movers = 3;
  std::size_t movers = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const std::string text = random_world_yaml(config, shapes(), 0.3, seed);
    EXPECT_EQ(text.find(random_world_yaml({}, shapes(), 0.3, seed)), 0U) << "seed " << seed;
    const World world = loaded(text);
    EXPECT_LE(world.movers.size(), 3U);
    movers += world.movers.size();
    for (const WorldMover& mover : world.movers) {
      EXPECT_GT((mover.path_m[0] - config.start_m).norm(), config.start_gap_m + 1.0);
      for (const WorldObject& object : world.objects)
        EXPECT_GT(distance_to_way(object.T_map_object.position(), mover), 0.5 * object.contour.outer_diameter_m() + 0.2)
            << "seed " << seed;
    }
  }
  EXPECT_GT(movers, 30U);
}

TEST(RandomWorld, DoorsLeadToMoreRoomsInTheEast) {
  RandomWorldConfig config;
  config.max_doors = 2;
  std::size_t doors = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const World plain = loaded(random_world_yaml({}, shapes(), 0.3, seed));
    const World world = loaded(random_world_yaml(config, shapes(), 0.3, seed));
    doors += world.doors.size();
    EXPECT_EQ(world.objects.size(), plain.objects.size());
    EXPECT_EQ(world.walls.size(), plain.walls.size() + 2 * world.doors.size());
    for (const WorldDoor& door : world.doors) {
      EXPECT_GE(door.from_m.x(), plain.max_m.x());
      EXPECT_GT(world.max_m.x(), door.from_m.x() + 1.9);
      EXPECT_NEAR((door.to_m - door.from_m).norm(), 1.0, 1e-9);
      EXPECT_GT(door.closed_for_s, 0.0);
      EXPECT_FALSE(door.closes_at(0.0));
    }
  }
  EXPECT_GT(doors, 20U);
}

}  // namespace
}  // namespace cairn
