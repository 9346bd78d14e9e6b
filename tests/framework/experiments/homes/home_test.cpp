#include "framework/experiments/homes/home.hpp"

#include <gtest/gtest.h>

#include <set>

#include "framework/experiments/trials/true_space.hpp"
#include "framework/files/world_file.hpp"
#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

World loaded(const Home& home) {
  const config_test::TestFolder folder;
  return load_world(folder.write("world.yaml", home.world_yaml), {});
}

TEST(RandomHome, KeepsItsRangesOnEverySeed) {
  const HomesConfig config;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Home home = random_home(config, seed);
    EXPECT_GE(home.rooms.size(), 3U) << "seed " << seed;
    EXPECT_LE(home.rooms.size(), 6U) << "seed " << seed;
    EXPECT_GE(home.doors.size(), home.rooms.size() - 1) << "seed " << seed;
    for (const HomeDoor& door : home.doors) {
      EXPECT_GE(door.width_m, config.min_door_m);
      EXPECT_LE(door.width_m, config.max_door_m);
    }
    const Point size_m = loaded(home).max_m;
    EXPECT_GE(size_m.prod(), config.min_area_m2 - 0.1);
    EXPECT_LE(size_m.prod(), config.max_area_m2 + 0.1);
  }
}

TEST(RandomHome, DoorsAreGapsFromJambToJamb) {
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    const Home home = random_home({}, seed);
    const World world = loaded(home);
    for (const HomeDoor& door : home.doors) {
      EXPECT_NEAR((door.to_m() - door.from_m()).norm(), door.width_m, 1e-9);
      for (const Point& end_m : {door.from_m(), door.to_m()})
        EXPECT_TRUE(std::ranges::any_of(world.walls,
                                        [&](const WorldWall& wall) {
                                          return (0.5 * (wall.points_m.front() + wall.points_m.back()) - end_m).norm() <
                                                 0.002;
                                        }))
            << "no jamb at " << end_m.transpose() << " of seed " << seed;
    }
  }
}

TEST(RandomHome, ARobotOfAnyOfTheThreeSizesGetsIntoEveryRoom) {
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    const Home home = random_home({}, seed);
    const std::vector<Point> reached = TrueSpace(loaded(home), 0.25).reached_from(home.start_m);
    for (std::size_t i = 0; i < home.rooms.size(); ++i)
      EXPECT_TRUE(std::ranges::any_of(reached, [&](const Point& p) { return home.rooms[i].contains(p); }))
          << "room " << i << " of seed " << seed << "\n"
          << home.world_yaml;
  }
}

TEST(RandomHome, NothingLeadsOutOfIt) {
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    const Home home = random_home({}, seed);
    for (const Point& p : TrueSpace(loaded(home), 0.18).reached_from(home.start_m)) {
      const bool is_inside = std::ranges::any_of(home.rooms, [&](const HomeRoom& room) { return room.contains(p); }) ||
                             std::ranges::any_of(home.doors, [&](const HomeDoor& door) {
                               return (p - door.middle_m).norm() < door.width_m;
                             });
      ASSERT_TRUE(is_inside) << p.transpose() << " of seed " << seed;
    }
  }
}

TEST(RandomHome, TagsHangOnFacesWithRoomBeforeThemAndChangeNothingElse) {
  HomesConfig config;
  config.tags = 10;
  for (std::uint64_t seed = 1001; seed < 1031; ++seed) {
    const Home home = random_home(config, seed);
    EXPECT_EQ(home.world_yaml.find(random_home({}, seed).world_yaml), 0U) << "seed " << seed;
    const World world = loaded(home);
    const TrueSpace space(world, 0.001);
    ASSERT_EQ(world.tags.size(), 10U) << "seed " << seed;
    std::set<MarkerId> numbers;
    for (const WorldTag& tag : world.tags) {
      numbers.insert(tag.marker);
      EXPECT_FALSE(space.has_room(tag.T_map_tag.position())) << "it hangs in the air, seed " << seed;
      for (const double before_m : {0.15, 0.45})
        EXPECT_TRUE(space.has_room(tag.T_map_tag * Point(before_m, 0.0)))
            << "tag " << tag.marker.number << " of seed " << seed << "\n"
            << home.world_yaml;
    }
    EXPECT_EQ(numbers.size(), 10U);
  }
}

TEST(RandomHome, IsTheSameForTheSameSeed) {
  EXPECT_EQ(random_home({}, 5).world_yaml, random_home({}, 5).world_yaml);
  EXPECT_NE(random_home({}, 5).world_yaml, random_home({}, 6).world_yaml);
}

}  // namespace
}  // namespace cairn
