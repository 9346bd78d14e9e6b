#include "maps/edit/merge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "maps/grid/grid_overlay.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;

constexpr double kCell_m = 0.05;

OccupancyGrid random_grid(std::mt19937& random, const Point& origin_m, const CellBox& box, double clamp_nat = 4.0) {
  OccupancyGrid grid(kCell_m, clamp_nat, origin_m);
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (random() % 3 != 0) grid.set_log_odds({x, y}, static_cast<LogOdds>(static_cast<int>(random() % 2049) - 1024));
  return grid;
}

// Which cell of b holds the point, without any lattice arithmetic of the code.
int log_odds_at(const OccupancyGrid& b, const Point& p) {
  const CellBox box = b.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) {
      const Point offset = p - b.centre_of({x, y});
      if (offset.cwiseAbs().maxCoeff() <= kCell_m / 2.0) return b.log_odds({x, y});
    }
  return 0;
}

TEST(GridOverlay, IsTheSumOfBothAtEveryPlaceAndTurn) {
  std::mt19937 random(7);
  for (int round = 0; round < 40; ++round) {
    const OccupancyGrid a = random_grid(random, {0.3, -1.0}, {{-4, -3}, {12, 9}}, 3.0);
    const OccupancyGrid b = random_grid(random, {-2.0, 0.7}, {{2, 5}, {14, 20}});
    std::uniform_real_distribution<double> metres(-1.0, 1.0);
    std::uniform_real_distribution<double> turn(-3.1, 3.1);
    const Pose2 T_a_b{metres(random), metres(random), turn(random)};
    const OccupancyGrid sum = with_evidence_of(a, b, T_a_b);
    EXPECT_EQ(sum.origin_m(), a.origin_m());
    const CellBox all = united(a.bounds(), box_over(a, b, T_a_b)).grown(3);
    for (int y = all.min.y; y < all.max.y; ++y)
      for (int x = all.min.x; x < all.max.x; ++x) {
        const int expected = a.log_odds({x, y}) + log_odds_at(b, inverse(T_a_b) * a.centre_of({x, y}));
        ASSERT_EQ(sum.log_odds({x, y}), std::clamp(expected, -768, 768)) << round << " at " << x << "," << y;
      }
  }
}

TEST(GridOverlay, WholeCellsAndRightAnglesMoveCellsAsTheyAre) {
  std::mt19937 random(3);
  const OccupancyGrid nothing(kCell_m);
  const OccupancyGrid b = random_grid(random, {0.0, 0.0}, {{0, 0}, {9, 5}});
  OccupancyGrid a(kCell_m);
  a.set_log_odds({-100, -100}, 5);
  const OccupancyGrid shifted = with_evidence_of(a, b, {10 * kCell_m, -3 * kCell_m, 0.0});
  const OccupancyGrid turned = with_evidence_of(a, b, {0.0, 0.0, radians(90.0)});
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 9; ++x) {
      EXPECT_EQ(shifted.log_odds({x + 10, y - 3}), b.log_odds({x, y}));
      EXPECT_EQ(turned.log_odds({-1 - y, x}), b.log_odds({x, y}));
    }
  EXPECT_TRUE(with_evidence_of(nothing, b, {}) == b);
  EXPECT_TRUE(with_evidence_of(b, nothing, {1.0, 2.0, 3.0}) == b);
}

// A wall of one cell must not get a hole that one can pass through side by side.
TEST(GridOverlay, ATurnedWallStaysClosed) {
  OccupancyGrid wall(kCell_m);
  for (int x = -60; x < 60; ++x) wall.set_log_odds({x, 0}, 1024);
  for (int angle_deg = 0; angle_deg < 180; angle_deg += 7) {
    OccupancyGrid a(kCell_m);
    a.set_log_odds({0, 500}, -5);
    const OccupancyGrid turned = with_evidence_of(a, wall, {0.013, 0.021, radians(angle_deg)});
    // Flood from one side through edges of cells: it must not reach the other.
    const CellBox arena{{-25, -25}, {26, 26}};
    std::vector<Cell> open{angle_deg > 45 && angle_deg < 135 ? Cell{-25, 0} : Cell{0, -25}};
    std::vector<bool> seen(51 * 51);
    while (!open.empty()) {
      const Cell at = open.back();
      open.pop_back();
      if (!arena.contains(at) || turned.log_odds(at) > 0) continue;
      const auto index = static_cast<std::size_t>((at.y + 25) * 51 + at.x + 25);
      if (seen[index]) continue;
      seen[index] = true;
      for (const Cell step : {Cell{1, 0}, Cell{-1, 0}, Cell{0, 1}, Cell{0, -1}}) open.push_back(at + step);
    }
    const Cell beyond = angle_deg > 45 && angle_deg < 135 ? Cell{25, 0} : Cell{0, 25};
    EXPECT_FALSE(seen[static_cast<std::size_t>((beyond.y + 25) * 51 + beyond.x + 25)]) << angle_deg;
  }
}

TEST(GridOverlay, OtherCellSizesAndTooLargeGridsAreRefused) {
  OccupancyGrid a(0.05);
  OccupancyGrid b(0.1);
  a.set_log_odds({0, 0}, 1);
  b.set_log_odds({0, 0}, 1);
  try {
    static_cast<void>(with_evidence_of(a, b, {}));
    FAIL();
  } catch (const std::invalid_argument& refused) {
    EXPECT_STREQ(refused.what(), "their grids have cells of different size, 0.05 m and 0.1 m");
  }
  EXPECT_THROW(static_cast<void>(with_evidence_of(a, a, {1e5, 0.0, 0.0})), std::length_error);
}

Landmark landmark(const std::string& category, double x_m, double y_m, const std::string& name = "") {
  Landmark made;
  made.category = category;
  made.name = name;
  made.T_map_landmark = {x_m, y_m, 0.0};
  return made;
}

Route route(LandmarkId from, LandmarkId to, double cost_m, std::vector<Pose2> trajectory = {}) {
  Route made;
  made.from = from;
  made.to = to;
  made.cost_m = cost_m;
  made.trajectory = std::move(trajectory);
  return made;
}

class MergedMaps : public testing::Test {
 protected:
  SavedMap a_;
  SavedMap b_;
  [[nodiscard]] MergedMap merged(const Pose2& T_a_b = {}, double near_m = 0.4) const {
    return merge_maps(a_, b_, {T_a_b, near_m});
  }
};

TEST_F(MergedMaps, LandmarksOfOneCategoryNearEachOtherAreOne) {
  a_.graph.add(landmark("square", 0, 0));
  a_.graph.add(landmark("square", 5, 0));
  b_.graph.add(landmark("square", 0.3, 0));  // L1
  b_.graph.add(landmark("circle", 5.1, 0));  // of another category
  b_.graph.add(landmark("square", 5, 0.5));  // too far
  b_.graph.add(landmark("square", 0.1, 0));  // nearer to L1 than b's first
  const MergedMap result = merged();
  EXPECT_EQ(result.joined_landmarks, 1U);
  std::vector<double> x;
  for (const auto& [id, l] : result.map.graph.landmarks()) x.push_back(l.T_map_landmark.x_m);
  EXPECT_THAT(x, ElementsAre(0, 5, 0.3, 5.1, 5));
}

TEST_F(MergedMaps, SubmapsAreThoseOfTheFirst) {
  a_.submaps.nodes = {{0, 1.0, {1, 2, 0.5}}};
  b_.submaps.nodes = {{0, 2.0, {}}};
  EXPECT_EQ(merged().map.submaps, a_.submaps);
}

TEST_F(MergedMaps, AJoinedLandmarkKeepsItsPlaceAndGetsTheEvidenceOfBoth) {
  Landmark mine = landmark("square", 0, 0);
  mine.sightings = 3;
  mine.degree = 0.5;
  mine.evidence = {{"square", 3, 0.5, 0.6, 0.4}};
  Landmark other = landmark("square", 0.2, 0, "dock");
  other.sightings = 1;
  other.degree = 0.9;
  other.templates = {{"square", 0.5, 0.9}};
  other.evidence = {{"circle", 1, 0.2, 0.2, 0.2}, {"square", 1, 0.9, 0.9, 0.9}};
  a_.graph.add(mine);
  b_.graph.add(other);
  const Landmark one = *merged().map.graph.find(1);
  EXPECT_EQ(one.T_map_landmark, (Pose2{0, 0, 0}));
  EXPECT_EQ(one.name, "dock");
  EXPECT_EQ(one.sightings, 4);
  EXPECT_EQ(one.degree, 0.9);
  EXPECT_EQ(one.templates, other.templates);
  ASSERT_EQ(one.evidence.size(), 2U);
  EXPECT_EQ(one.evidence[0].category, "circle");
  EXPECT_EQ(one.evidence[1].matchings, 4);
  EXPECT_NEAR(one.evidence[1].mean_degree, 0.6, 1e-12);
  EXPECT_EQ(one.evidence[1].best_degree, 0.9);
}

TEST_F(MergedMaps, TheSecondMapIsLaidOverByTheTransform) {
  a_.graph.add(landmark("square", 0, 0));
  Landmark other = landmark("square", 1, 0);
  other.access = Pose2{2, 0, 0.1};
  b_.graph.add(other);
  b_.graph.add(landmark("circle", 1, 3));
  b_.graph.add_route(route(1, 2, 3.0, {{2, 0, 0.1}, {1, 3, 0}}));
  const LandmarkGraph graph = merged({10, 0, radians(90)}).map.graph;
  const Landmark& moved = *graph.find(2);
  EXPECT_NEAR(moved.T_map_landmark.x_m, 10, 1e-12);
  EXPECT_NEAR(moved.T_map_landmark.y_m, 1, 1e-12);
  EXPECT_NEAR(moved.T_map_landmark.theta_rad, radians(90), 1e-12);
  EXPECT_NEAR(moved.access->y_m, 2, 1e-12);
  const Route& there = *graph.find_route(1);
  EXPECT_EQ(there.from, 2);
  EXPECT_EQ(there.to, 3);
  EXPECT_NEAR(there.trajectory.back().x_m, 7, 1e-12);
  EXPECT_NEAR(there.trajectory.front().theta_rad, radians(90) + 0.1, 1e-12);
}

TEST_F(MergedMaps, NamesThatClashGetASuffix) {
  a_.graph.add(landmark("square", 0, 0, "dock"));
  b_.graph.add(landmark("square", 9, 0, "dock"));
  b_.graph.add(landmark("square", 18, 0, "dock_2"));
  b_.graph.add(landmark("square", 27, 0, "lab"));
  const MergedMap result = merged();
  std::vector<std::string> names;
  for (const auto& [id, l] : result.map.graph.landmarks()) names.push_back(l.name);
  EXPECT_THAT(names, ElementsAre("dock", "dock_3", "dock_2", "lab"));
  EXPECT_THAT(result.warnings, ElementsAre("1 landmark: the name is taken, so it got a suffix"));
}

TEST_F(MergedMaps, ARouteThatTheFirstMapHasIsNotTakenTwice) {
  for (SavedMap* map : {&a_, &b_}) {
    map->graph.add(landmark("square", 0, 0));
    map->graph.add(landmark("circle", 4, 0));
    map->graph.add_route(route(1, 2, map == &a_ ? 4.0 : 4.7));
  }
  b_.graph.add_route(route(2, 1, 4.0));
  b_.graph.add_route(route(1, 2, 9.0));  // another way
  const MergedMap result = merged();
  EXPECT_EQ(result.joined_routes, 1U);
  std::vector<double> costs;
  for (const auto& [id, r] : result.map.graph.routes()) costs.push_back(r.cost_m);
  EXPECT_THAT(costs, ElementsAre(4.0, 4.0, 9.0));
}

TEST_F(MergedMaps, ATrajectoryThatEndsElsewhereIsLeftAway) {
  a_.graph.add(landmark("square", 0, 0));
  b_.graph.add(landmark("square", 0.3, 0));
  b_.graph.add(landmark("circle", 4, 0));
  b_.graph.add_route(route(1, 2, 4.0, {{0.3, 0, 0}, {4, 0, 0}}));
  b_.graph.add_route(route(2, 1, 4.0, {{4, 0, 0}, {0.02, 0, 0}}));
  const MergedMap result = merged();
  EXPECT_TRUE(result.map.graph.find_route(1)->trajectory.empty());
  EXPECT_EQ(result.map.graph.find_route(1)->cost_m, 4.0);
  EXPECT_EQ(result.map.graph.find_route(2)->trajectory.size(), 2U);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_TRUE(result.warnings[0].starts_with("1 route: the trajectory ends elsewhere"));
}

TEST_F(MergedMaps, RetiredLandmarksShapesAndTheLargerRobotAreKept) {
  a_.graph.add(landmark("square", 0, 0));
  a_.progress = MissionProgress();
  a_.properties = {{"robot_radius_m", "0.2"}, {"mission", "one"}};
  b_.properties = {{"robot_radius_m", "0.3"}, {"mission", "two"}};
  b_.graph.add(landmark("square", 3, 0));
  b_.graph.retire(1, "gone");
  const SavedMap map = merged({1, 0, 0}).map;
  ASSERT_EQ(map.graph.retired().size(), 1U);
  EXPECT_EQ(map.graph.retired().begin()->first, 2);
  EXPECT_NEAR(map.graph.retired().begin()->second.landmark.T_map_landmark.x_m, 4.0, 1e-12);
  EXPECT_EQ(map.properties.at("robot_radius_m"), "0.3");
  EXPECT_EQ(map.properties.at("mission"), "one");
  EXPECT_FALSE(map.progress);
}

TEST_F(MergedMaps, AMapAndItsLikeAreTheMapItself) {
  std::mt19937 random(5);
  for (int i = 0; i < 30; ++i) a_.graph.add(landmark("square", 2.0 * i, 0, "n" + std::to_string(i)));
  for (int i = 0; i < 60; ++i)
    a_.graph.add_route(route(1 + static_cast<LandmarkId>(random() % 30), 1 + static_cast<LandmarkId>(random() % 30),
                             static_cast<double>(random() % 9)));
  b_ = a_;
  const MergedMap result = merged();
  EXPECT_EQ(result.map.graph, a_.graph);
  EXPECT_EQ(result.joined_landmarks, 30U);
  EXPECT_EQ(result.joined_routes, 60U);
}

Landmark tag_at(int number, const Point& at_m) {
  Landmark tag;
  tag.marker = MarkerId{MarkerFamily::tag36h11, number};
  tag.T_map_landmark = {at_m.x(), at_m.y(), 0.0};
  return tag;
}

TEST(MergedMap, JoinsTagsOfOneNumberHoweverFarAndNoOthersHoweverNear) {
  SavedMap a;
  SavedMap b;
  a.graph.add(tag_at(1, {0.0, 0.0}));
  a.graph.add(tag_at(2, {5.0, 0.0}));
  b.graph.add(tag_at(3, {0.05, 0.0}));
  b.graph.add(tag_at(2, {3.0, 0.0}));
  Landmark shape;
  shape.category = "square";
  shape.T_map_landmark = {5.0, 0.1, 0.0};
  b.graph.add(shape);
  const MergedMap merged = merge_maps(a, b, MergeOptions{});
  EXPECT_EQ(merged.joined_landmarks, 1U);
  ASSERT_EQ(merged.map.graph.landmarks().size(), 4U);
  EXPECT_EQ(merged.map.graph.find_by_name("tag 3")->T_map_landmark.x_m, 0.05);
}

}  // namespace
}  // namespace cairn
