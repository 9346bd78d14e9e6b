// Routes that are counted by what driving them takes.

#include "planners/common/disc_space/driving_time.hpp"

#include <gtest/gtest.h>

#include <random>

#include "planners/common/disc_space/routes.hpp"
#include "tests/planners/ompl/ompl_worlds.hpp"

namespace cairn {
namespace {

constexpr double kRadius_m = 0.22;
constexpr double kCell_m = 0.05;

// Two rooms, 8 x 4 m, and a door of 0.8 m that is not where the ends look.
const char* const kDoor =
    "########################################\n"
    "#..................##..................#\n"
    "#..................##..................#\n"
    "#..................##..................#\n"
    "#.A................##................B.#\n"
    "#..................##..................#\n"
    "#..................##..................#\n"
    "#..................##..................#\n"
    "#..................##..................#\n"
    "#..................##..................#\n"
    "#......................................#\n"
    "#......................................#\n"
    "#......................................#\n"
    "#......................................#\n"
    "#..................##..................#\n"
    "#..................##..................#\n"
    "########################################\n";

// Past the end of a wall, on open ground.
const char* const kCorner =
    "##############################\n"
    "#..............#.............#\n"
    "#..............#.............#\n"
    "#..............#.............#\n"
    "#..A...........#..........B..#\n"
    "#..............#.............#\n"
    "#..............#.............#\n"
    "#............................#\n"
    "#............................#\n"
    "#............................#\n"
    "#............................#\n"
    "##############################\n";

// Straight on through a gap that hardly fits, or round over open ground, which is longer.
const char* const kGapOrRound =
    "##############################\n"
    "#............................#\n"
    "#............................#\n"
    "#............................#\n"
    "#............................#\n"
    "#.........##########.........#\n"
    "#.........##########.........#\n"
    "#.........##########.........#\n"
    "#....A..................B....#\n"
    "#............................#\n"
    "#.........##########.........#\n"
    "##############################\n";

WorldView known(const test::DrawnWorld& world) {
  WorldView view = world.view();
  view.speed_law = SpeedLaw{};
  return view;
}

PathResult plan(const WorldView& world, const PathRequest& request, const OmplConfig& config = {}) {
  return OmplPlanner(config).plan(request, world, {});
}

OmplConfig by(Objective objective, std::int64_t improve_iterations = OmplConfig{}.improve_iterations) {
  OmplConfig config;
  config.objective = objective;
  config.improve_iterations = improve_iterations;
  return config;
}

// Where the path crosses a column.
double height_at(const std::vector<Pose2>& path, double x_m) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point a = path[i - 1].position();
    const Point b = path[i].position();
    if (std::min(a.x(), b.x()) <= x_m && x_m <= std::max(a.x(), b.x()) && a.x() != b.x())
      return a.y() + (b.y() - a.y()) * (x_m - a.x()) / (b.x() - a.x());
  }
  return -1.0;
}

test::DrawnWorld room_with_boxes(std::uint64_t seed) {
  constexpr int kSide = 100;
  std::mt19937_64 random(seed);
  test::DrawnWorld world;
  world.grid = OccupancyGrid(kCell_m);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) world.grid.set_log_odds({x, y}, LogOdds{-900});
  for (int box = 0; box < 9; ++box) {
    const Cell low{14 + static_cast<int>(random() % 62), 14 + static_cast<int>(random() % 62)};
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 8; ++x) world.grid.set_log_odds(low + Cell{x, y}, LogOdds{900});
  }
  world.places['A'] = {0.4, 0.4};
  world.places['B'] = {4.6, 4.6};
  world.robot.radius_m = kRadius_m;
  return world;
}

TEST(DrivingTimeRoutes, DoorsAreTakenInTheMiddle) {
  const auto world = test::drawn_world(kDoor, kCell_m, 4);
  const PathRequest request = world.request('A', 'B', kRadius_m);
  const PathResult fastest = plan(known(world), request);
  const PathResult shortest = plan(known(world), request, by(Objective::length));
  ASSERT_EQ(fastest.outcome, PlanOutcome::solved) << fastest.reason;
  // The door is 0.6 to 1.4 m above the lower edge of the map, and 0.4 m deep.
  for (const double x_m : {3.85, 4.0, 4.15})
    EXPECT_NEAR(height_at(fastest.path, x_m), 1.0, 0.04) << test::drawing_of(world.grid, fastest.path);
  EXPECT_GT(height_at(shortest.path, 4.0), 1.1);
  EXPECT_LT(*fastest.driving_time_s, *shortest.driving_time_s * 0.8);
}

TEST(DrivingTimeRoutes, OnOpenGroundTheyKeepTheirDistanceFromWallsAndCorners) {
  const auto world = test::drawn_world(kCorner, kCell_m, 4);
  const PathRequest request = world.request('A', 'B', kRadius_m);
  const PathResult shortest = plan(known(world), request, by(Objective::length));
  const PathResult fastest = plan(known(world), request);
  ASSERT_EQ(fastest.outcome, PlanOutcome::solved) << fastest.reason;
  EXPECT_LT(shortest.clearance_m, 0.01);
  EXPECT_GT(fastest.clearance_m, 0.14) << test::drawing_of(world.grid, fastest.path);
  EXPECT_GT(fastest.length_m, shortest.length_m);
}

TEST(DrivingTimeRoutes, AGapThatHardlyFitsIsTakenOnlyWhereTheWayRoundIsLong) {
  auto world = test::drawn_world(kGapOrRound, kCell_m, 5);  // the gap: 0.5 m wide and 2.5 m long
  const PathRequest request = world.request('A', 'B', kRadius_m);
  const PathResult round = plan(known(world), request);
  ASSERT_EQ(round.outcome, PlanOutcome::solved) << round.reason;
  EXPECT_GT(round.clearance_m, 0.1) << test::drawing_of(world.grid, round.path);
  // Where there is no way round, what is left is the gap, in its middle.
  for (int x = 8 * 5; x < 10 * 5; ++x)
    for (int y = 7 * 5; y < 11 * 5; ++y) world.grid.set_log_odds({x, y}, LogOdds{900});
  const PathResult through = plan(known(world), request);
  ASSERT_EQ(through.outcome, PlanOutcome::solved) << through.reason;
  // To half a cell: no more of the middle shows in distances between cells.
  EXPECT_NEAR(through.clearance_m, 0.03, 0.5 * kCell_m + 1e-6) << test::drawing_of(world.grid, through.path);
}

TEST(DrivingTimeRoutes, WhatOmplMakesOfARouteIsNeverSlowerThanItsStart) {
  int better = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto world = room_with_boxes(seed);
    const PathRequest request = world.request('A', 'B', kRadius_m);
    const PathResult start = plan(known(world), request, by(Objective::time, 0));
    if (start.outcome != PlanOutcome::solved) continue;
    double before_s = *start.driving_time_s;
    for (const std::int64_t iterations : {25, 100, 300}) {
      const PathResult improved = plan(known(world), request, by(Objective::time, iterations));
      EXPECT_LE(*improved.driving_time_s, before_s * (1.0 + 1e-9)) << "seed " << seed << ", " << iterations;
      before_s = *improved.driving_time_s;
    }
    better += before_s < *start.driving_time_s * 0.999;
    const PathResult shortest = plan(known(world), request, by(Objective::length));
    EXPECT_LE(*start.driving_time_s, *shortest.driving_time_s * (1.0 + 1e-9));
  }
  EXPECT_GT(better, 3);
}

TEST(DrivingTimeRoutes, TheLengthOfTheShortestPathBoundsThemFromBelow) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto world = room_with_boxes(seed);
    const PathResult fastest = plan(known(world), world.request('A', 'B', kRadius_m));
    if (fastest.outcome != PlanOutcome::solved) continue;
    ASSERT_TRUE(fastest.length_lower_bound_m);
    EXPECT_GE(fastest.length_m, *fastest.length_lower_bound_m * (1.0 - 1e-9));
    EXPECT_GE(*fastest.driving_time_s, *fastest.length_lower_bound_m / world.robot.max_v_mps * (1.0 - 1e-9));
  }
}

TEST(DrivingTimeRoutes, TheSameRequestGivesTheSameRoute) {
  const auto world = room_with_boxes(3);
  const PathRequest request = world.request('A', 'B', kRadius_m);
  const OmplPlanner planner({});
  const PathResult once = planner.plan(request, known(world), {});
  ASSERT_EQ(once.outcome, PlanOutcome::solved) << once.reason;
  const PathResult again = planner.plan(request, known(world), {});
  const PathResult anew = plan(known(world), request);
  EXPECT_EQ(once.path, again.path);
  EXPECT_EQ(once.path, anew.path);
}

TEST(DrivingTimeRoutes, ForAPointAndForARobotThatNobodyKnowsTheShortestPathIsTheAnswer) {
  const auto world = test::drawn_world(kCorner, kCell_m, 4);
  for (const double radius_m : {0.0, kRadius_m}) {
    const PathRequest request = world.request('A', 'B', radius_m);
    const PathResult asked = plan(world.view(), request);
    EXPECT_EQ(asked.path, plan(world.view(), request, by(Objective::length)).path);
    EXPECT_FALSE(asked.driving_time_s);
  }
  const PathRequest point = world.request('A', 'B', 0.0);
  EXPECT_EQ(plan(known(world), point).path, plan(world.view(), point).path);
}

TEST(DrivingTimeRoutes, ASlowDriveGoesNearerToCornersThanAFastOne) {
  const auto world = test::drawn_world(kCorner, kCell_m, 4);
  PathRequest request = world.request('A', 'B', kRadius_m);
  const PathResult fast = plan(known(world), request);
  request.speed_mps = 0.05;
  const PathResult slow = plan(known(world), request);
  EXPECT_LT(slow.length_m, fast.length_m);
  EXPECT_GT(*slow.driving_time_s, *fast.driving_time_s);
}

// Through OMPL's spaces: the centre keeps the clearance of the largest disc in the outline.
TEST(DrivingTimeRoutes, RobotsWithAShapeOrATurningCircleAreCountedByItToo) {
  auto world = test::drawn_world(kCorner, kCell_m, 4);
  world.robot.polygon_m = {{0.25, 0.2}, {-0.25, 0.2}, {-0.25, -0.2}, {0.25, -0.2}};
  world.robot.radius_m = 0.33;
  for (const MotionKind kind : {MotionKind::differential, MotionKind::reeds_shepp}) {
    const auto planned = [&](Objective objective) {
      OmplConfig config = by(objective);
      config.kinematics = kind;
      config.footprint = PlannerTraits::Shape::outline;
      config.turning_radius_m = kind == MotionKind::reeds_shepp ? 0.4 : 0.0;
      PathRequest request = world.request('A', 'B', world.robot.radius_m);
      return OmplPlanner(config, world.robot).plan(request, known(world), {});
    };
    const PathResult shortest = planned(Objective::length);
    const PathResult fastest = planned(Objective::as_driven);
    ASSERT_EQ(shortest.outcome, PlanOutcome::solved) << shortest.reason;
    ASSERT_EQ(fastest.outcome, PlanOutcome::solved) << fastest.reason;
    EXPECT_LT(*fastest.driving_time_s, *shortest.driving_time_s) << static_cast<int>(kind);
  }
}

}  // namespace
}  // namespace cairn
