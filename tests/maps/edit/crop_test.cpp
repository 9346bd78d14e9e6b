#include "maps/edit/crop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace cairn {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

SavedMap random_map(unsigned seed) {
  std::mt19937 random(seed);
  SavedMap map;
  map.grid = OccupancyGrid(0.05, 3.0, {0.1, -0.2});
  for (int y = -30; y < 40; ++y)
    for (int x = -20; x < 70; ++x)
      map.grid.set_log_odds({x, y}, static_cast<LogOdds>(static_cast<int>(random() % 1537) - 768));
  const auto at = [&] {
    return Pose2{static_cast<double>(random() % 400) / 100.0 - 1.0, static_cast<double>(random() % 300) / 100.0 - 1.5,
                 0.0};
  };
  for (int i = 0; i < 40; ++i) {
    Landmark landmark;
    landmark.T_map_landmark = at();
    if (i % 3 == 0) landmark.access = at();
    map.graph.add(landmark);
  }
  for (int i = 0; i < 80; ++i) {
    Route route;
    route.from = 1 + static_cast<LandmarkId>(random() % 40);
    route.to = 1 + static_cast<LandmarkId>(random() % 40);
    for (int k = 0; k < i % 4; ++k) route.trajectory.push_back(at());
    map.graph.add_route(route);
  }
  map.graph.retire(40, "gone");
  for (int i = 0; i < 30; ++i) map.driven_path.push_back(at());
  return map;
}

TEST(MapCrop, KeepsWhatLiesInsideAndNothingElse) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const SavedMap map = random_map(seed);
    const Point low(0.03 * seed - 0.5, -0.7);
    const Point high(2.011, 0.9 + 0.01 * seed);
    const auto inside = [&](const Point& p) {
      return p.x() >= low.x() && p.y() >= low.y() && p.x() <= high.x() && p.y() <= high.y();
    };
    const CroppedMap cropped = crop_map(map, {high.x(), low.y()}, {low.x(), high.y()});
    const OccupancyGrid& grid = cropped.map.grid;
    EXPECT_EQ(grid.origin_m(), map.grid.origin_m());
    for (int y = -32; y < 42; ++y)
      for (int x = -22; x < 72; ++x) {
        const bool is_in = inside(map.grid.centre_of({x, y})) && map.grid.bounds().contains({x, y});
        ASSERT_EQ(grid.log_odds({x, y}), is_in ? map.grid.log_odds({x, y}) : 0);
        ASSERT_EQ(grid.bounds().contains({x, y}), is_in) << x << "," << y;
      }
    for (const auto& [id, landmark] : map.graph.landmarks()) {
      const Landmark* kept = cropped.map.graph.find(id);
      ASSERT_EQ(kept != nullptr, inside(landmark.T_map_landmark.position()));
      if (kept != nullptr) {
        EXPECT_EQ(kept->access.has_value(), landmark.access && inside(landmark.access->position()));
      }
    }
    for (const auto& [id, route] : map.graph.routes()) {
      bool is_in = cropped.map.graph.find(route.from) != nullptr && cropped.map.graph.find(route.to) != nullptr;
      for (const Pose2& pose : route.trajectory) is_in = is_in && inside(pose.position());
      ASSERT_EQ(cropped.map.graph.find_route(id) != nullptr, is_in);
    }
    EXPECT_EQ(cropped.landmarks_dropped, map.graph.landmarks().size() - cropped.map.graph.landmarks().size());
    EXPECT_EQ(cropped.routes_dropped, map.graph.routes().size() - cropped.map.graph.routes().size());
    EXPECT_EQ(cropped.map.graph.next_landmark_id(), map.graph.next_landmark_id());
    for (const Pose2& pose : cropped.map.driven_path) EXPECT_TRUE(inside(pose.position()));
  }
}

TEST(MapCrop, ABoxOnCellEdgesTakesTheCellsBetween) {
  SavedMap map;
  map.grid.set_log_odds({0, 0}, 5);
  map.grid.set_log_odds({99, 99}, 5);
  EXPECT_EQ(crop_map(map, {1.0, 0.5}, {2.0, 1.5}).map.grid.bounds(), (CellBox{{20, 10}, {40, 30}}));
}

TEST(MapCrop, TheWholeBoxGivesTheMapBack) {
  const SavedMap map = random_map(9);
  const SavedMap whole = crop_map(map, {-100, -100}, {100, 100}).map;
  EXPECT_TRUE(whole.grid == map.grid);
  EXPECT_EQ(whole.graph, map.graph);
  EXPECT_EQ(whole.driven_path, map.driven_path);
}

TEST(MapCrop, ReportsWhatItForgets) {
  SavedMap map;
  Landmark landmark;
  landmark.access = Pose2{5, 0, 0};
  map.graph.add(landmark);
  map.clusters.clusters = {{1, {1, 1, 0, 1, "wing"}}};
  map.progress = MissionProgress();
  EXPECT_THAT(crop_map(map, {-1, -1}, {1, 1}).warnings,
              ElementsAre("no mission can resume from a part of its map: its progress is dropped",
                          "1 landmark: where a robot stands at it lies outside and is forgotten",
                          "1 cluster: made anew, the name is lost"));
}

TEST(MapCrop, SubmapsShowWhatIsCutOffAndGo) {
  SavedMap map = random_map(1);
  map.submaps.nodes = {{0, 1.0, {}}};
  const CroppedMap cropped = crop_map(map, {-1, -1}, {1, 1});
  EXPECT_TRUE(cropped.map.submaps.empty());
  EXPECT_THAT(cropped.warnings, Contains("the submaps show what is cut off: they are dropped"));
}

TEST(MapCrop, NoMissionGoesOnFromAPart) {
  SavedMap map = random_map(1);
  map.progress = MissionProgress();
  EXPECT_FALSE(crop_map(map, {-100, -100}, {100, 100}).map.progress);
}

std::string refusal(const SavedMap& map, const Point& a, const Point& b) {
  try {
    static_cast<void>(crop_map(map, a, b));
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return "accepted";
}

TEST(MapCrop, RefusesBoxesThatAreNoneAndThoseBesideTheMap) {
  SavedMap map;
  map.grid.set_log_odds({0, 0}, 5);
  map.grid.set_log_odds({9, 19}, 5);
  EXPECT_EQ(refusal(map, {5, 5}, {6, 6.5}),
            "nothing of the map lies in the box 5,5 to 6,6.5; the map reaches from 0,0 to 0.5,1");
  EXPECT_THAT(refusal(SavedMap(), {5, 5}, {6, 6.5}), HasSubstr("; the map is empty"));
  for (const Point& corner : {Point(0, 1), Point(1, 0), Point(std::nan(""), 1), Point(1, HUGE_VAL)})
    EXPECT_EQ(refusal(map, {0, 0}, corner), "a box needs two finite corners and some width and height");
}

}  // namespace
}  // namespace cairn
