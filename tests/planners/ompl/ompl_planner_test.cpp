#include "planners/ompl/ompl_planner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "planners/common/disc_space/routes.hpp"
#include "tests/planners/ompl/ompl_worlds.hpp"

namespace cairn {
namespace {

using test::drawn_world;
using ::testing::HasSubstr;

PathResult plan(const test::DrawnWorld& world, const PathRequest& request, const OmplConfig& config = {}) {
  return OmplPlanner(config).plan(request, world.view(), {});
}

const char* const kSplit =
    "################\n"
    "#......#.......#\n"
    "#.A....#.....B.#\n"
    "#......#.......#\n"
    "################\n";

TEST(OmplPlanner, GoesStraightWhereNothingIsInTheWay) {
  const auto world = drawn_world(test::kOffice);
  const PathResult result = plan(world, world.request('C', 'D', 0.1));
  EXPECT_EQ(result.outcome, PlanOutcome::solved);
  EXPECT_GT(result.path.size(), 2U) << "a door post is in the way of C to D";
  PathRequest request = world.request('A', 'C', 0.1);
  request.to.pose = Pose2{0.9, 0.5, 2.0};
  const PathResult straight = plan(world, world.request('C', 'C', 0.1));
  EXPECT_EQ(straight.outcome, PlanOutcome::solved);
  EXPECT_EQ(straight.path.size(), 1U);
  EXPECT_EQ(straight.length_m, 0.0);
}

TEST(OmplPlanner, WhatIsWalledOffHasNoRouteAndNoSearchIsMadeForIt) {
  const auto world = drawn_world(kSplit);
  OmplConfig config;
  config.iterations = 1'000'000'000;  // would never end
  const PathResult result = plan(world, world.request('A', 'B', 0.1), config);
  EXPECT_EQ(result.outcome, PlanOutcome::no_route);
  EXPECT_EQ(result.reason, "the goal (1.35, 0.25) cannot be reached: what is free around the start ends before it");
  EXPECT_TRUE(result.path.empty());
}

TEST(OmplPlanner, AThinWallIsNeverCutWhateverTheSeed) {
  const auto world = drawn_world(
      "..............#..............\n"
      "..............#..............\n"
      "..A...........#...........B..\n"
      "..............#..............\n"
      "..............#..............\n"
      ".............................\n"
      ".............................\n",
      0.02);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const Algorithm algorithm : {Algorithm::rrt_connect, Algorithm::rrt, Algorithm::prm}) {
      PathRequest request = world.request('A', 'B', 0.01);
      request.seed = seed;
      OmplConfig config;
      config.algorithm = algorithm;
      const PathResult result = plan(world, request, config);
      ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
      EXPECT_GE(test::distance_by_brute_force(world.grid, result.path, false, 0.001), 0.01 - 1e-9)
          << test::drawing_of(world.grid, result.path);
    }
  }
}

TEST(OmplPlanner, ARobotWiderThanThePassageIsReported) {
  const auto world = drawn_world(
      "#################\n"
      "#.......#.......#\n"
      "#...A.......B...#\n"
      "#.......#.......#\n"
      "#################\n");
  const PathResult result = plan(world, world.request('A', 'B', 0.12));
  EXPECT_EQ(result.outcome, PlanOutcome::no_route);
  EXPECT_THAT(result.reason, HasSubstr("too narrow for a robot of radius 0.12 m"));
  EXPECT_EQ(plan(world, world.request('A', 'B', 0.04)).outcome, PlanOutcome::solved);
}

TEST(OmplPlanner, APointPassesAnyGapOfOneCell) {
  const auto world = drawn_world(
      "#########\n"
      "#A#...#.#\n"
      "#.#.#.#.#\n"
      "#.#.#.#.#\n"
      "#...#..B#\n"
      "#########\n");
  const PathResult result = plan(world, world.request('A', 'B', 0.0));
  EXPECT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
}

TEST(OmplPlanner, ABlockedGoalIsNamedWithTheNearestFreePlace) {
  const auto world = drawn_world(test::kOffice);
  PathRequest request = world.request('A', 'B', 0.14);
  request.to.pose = Pose2{2.25, 1.05, 0.0};
  const PathResult result = plan(world, request);
  EXPECT_EQ(result.outcome, PlanOutcome::goal_blocked);
  EXPECT_EQ(result.reason,
            "the goal (2.25, 1.05) is blocked: an occupied cell is 0.05 m from its centre, and the robot needs "
            "0.14 m; the nearest free place is (2.150, 1.050), 0.10 m away");
  request.to.pose = Pose2{9.0, 9.0, 0.0};
  EXPECT_EQ(plan(world, request).outcome, PlanOutcome::goal_blocked);
  EXPECT_THAT(plan(world, request).reason, HasSubstr("outside the map"));
}

TEST(OmplPlanner, ABlockedStartIsNamedUnlessAStepFreesIt) {
  const auto world = drawn_world(test::kOffice);
  PathRequest request = world.request('A', 'B', 0.14);
  request.from.pose = Pose2{0.05, 0.5, 0.0};
  EXPECT_EQ(plan(world, request).outcome, PlanOutcome::start_blocked);
  EXPECT_THAT(plan(world, request).reason, HasSubstr("it lies on an occupied cell"));
  request.from.pose = Pose2{-3.0, 0.5, 0.0};
  EXPECT_EQ(plan(world, request).outcome, PlanOutcome::start_blocked);
  EXPECT_THAT(plan(world, request).reason, HasSubstr("outside the map"));

  request.from.pose = Pose2{0.18, 0.55, 0.0};  // 0.08 m from the wall
  const PathResult result = plan(world, request);
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("less clearance"));
  EXPECT_EQ(result.path.front().position(), request.from.pose->position());
  EXPECT_TRUE(test::keeps_clear(world.grid, {result.path.begin() + 1, result.path.end()}, 0.14));
  EXPECT_GE(test::distance_by_brute_force(world.grid, result.path), 0.08 - 1e-4);
  EXPECT_EQ(result.clearance_m, 0.0);
  OmplConfig strict;
  strict.start_tolerance_m = 0.0;
  EXPECT_EQ(plan(world, request, strict).outcome, PlanOutcome::start_blocked);
}

TEST(OmplPlanner, UnknownGroundUnderTheRobotItselfDoesNotBlock) {
  auto world = drawn_world(
      "###############\n"
      "#.............#\n"
      "#.??..........#\n"
      "#.?A......B...#\n"
      "#.???.........#\n"
      "#.............#\n"
      "###############\n");
  const PathRequest request = world.request('A', 'B', 0.12);
  OmplConfig config;
  config.start_tolerance_m = 0.05;
  EXPECT_EQ(plan(world, request, config).outcome, PlanOutcome::start_blocked) << "nobody says the robot is there";
  const Observation observation;
  WorldView live{world.grid, world.graph, world.robot, {world.pose('A'), {}}, 1.0, &observation, 0.0};
  const PathResult result = OmplPlanner(config).plan(request, live, {});
  EXPECT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
}

TEST(OmplPlanner, UnknownSpaceIsCrossedOnlyWhenAllowed) {
  const auto world = drawn_world(
      "###########\n"
      "#.A.??..B.#\n"
      "#...??....#\n"
      "###########\n");
  OmplConfig config;
  EXPECT_EQ(plan(world, world.request('A', 'B', 0.04), config).outcome, PlanOutcome::no_route);
  config.unknown = UnknownGround::allow;
  EXPECT_EQ(plan(world, world.request('A', 'B', 0.04), config).outcome, PlanOutcome::solved);
}

TEST(OmplPlanner, NumbersThatAreNotFiniteAreNoPlace) {
  const auto world = drawn_world(test::kOffice);
  PathRequest request = world.request('A', 'B', 0.1);
  request.to.pose->x_m = NAN;
  EXPECT_EQ(plan(world, request).outcome, PlanOutcome::unknown_place);
  EXPECT_EQ(plan(world, request).reason, "the goal is not a place: its numbers are not finite");
  request = world.request('A', 'B', 0.1);
  request.from.pose->theta_rad = INFINITY;
  EXPECT_EQ(plan(world, request).outcome, PlanOutcome::unknown_place);
  request = world.request('A', 'B', NAN);
  EXPECT_THROW((void)plan(world, request), std::invalid_argument);
}

TEST(OmplPlanner, AMapWithoutAGridAndABudgetOfNothingAreOutcomes) {
  const auto world = drawn_world(test::kOffice);
  Budget none;
  none.iterations = 0;
  EXPECT_EQ(OmplPlanner({}).plan(world.request('A', 'B', 0.1), world.view(), none).outcome, PlanOutcome::out_of_budget);
  const test::DrawnWorld empty;
  PathRequest request;
  request.from.pose = Pose2{};
  request.to.pose = Pose2{1.0, 0.0, 0.0};
  const PathResult result = plan(empty, request);
  EXPECT_EQ(result.outcome, PlanOutcome::start_blocked);
  EXPECT_EQ(result.reason, "the map holds no grid to plan a route on");
}

TEST(OmplPlanner, WhatEndsShortOfTheGoalIsNeverCalledSolved) {
  const auto world = drawn_world(test::kOffice);
  OmplConfig config;
  config.algorithm = Algorithm::rrt;
  config.iterations = 3;
  config.fall_back_to_grid = false;
  int approximate = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    PathRequest request = world.request('A', 'B', 0.15);
    request.seed = seed;
    const PathResult result = plan(world, request, config);
    EXPECT_NE(result.outcome, PlanOutcome::solved);
    if (result.outcome != PlanOutcome::approximate) continue;
    ++approximate;
    EXPECT_NE(result.path.back().position(), world.places.at('B'));
    EXPECT_TRUE(test::keeps_clear(world.grid, result.path, 0.15));
    EXPECT_THAT(result.reason, HasSubstr("short of the goal"));
  }
  EXPECT_GT(approximate, 0);
}

TEST(OmplPlanner, WhereSamplingFindsNothingTheGridHelps) {
  const auto world = drawn_world(test::kOffice);
  OmplConfig config;
  config.algorithm = Algorithm::rrt_connect;
  config.iterations = 1;
  const PathResult result = plan(world, world.request('A', 'B', 0.15), config);
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("sampling found nothing"));
  EXPECT_TRUE(test::keeps_clear(world.grid, result.path, 0.15));
}

TEST(OmplPlanner, TheMarginIsKeptAndTheClearanceIsTheRobotsOwn) {
  const auto world = drawn_world(test::kOffice);
  OmplConfig config;
  config.margin_m = 0.06;
  const PathResult result = plan(world, world.request('A', 'B', 0.1), config);
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_TRUE(test::keeps_clear(world.grid, result.path, 0.16));
  EXPECT_NEAR(result.clearance_m, test::distance_by_brute_force(world.grid, result.path) - 0.1, 0.005);
}

TEST(OmplPlanner, TheGoalsHeadingIsTakenOnlyWhereItMatters) {
  const auto world = drawn_world(test::kOffice);
  PathRequest request = world.request('A', 'B', 0.1);
  request.to.pose->theta_rad = 2.5;
  const PathResult any = plan(world, request);
  const Point last = any.path.back().position() - any.path[any.path.size() - 2].position();
  EXPECT_NEAR(any.path.back().theta_rad, std::atan2(last.y(), last.x()), 1e-12);
  request.to.heading_matters = true;
  EXPECT_EQ(plan(world, request).path.back().theta_rad, 2.5);
}

TEST(OmplPlanner, OfSeveralLandmarksTakesTheNearestByTravelThatCanBeReached) {
  auto world = drawn_world(test::kOffice);
  Landmark landmark;
  landmark.T_map_landmark = {1.15, 1.0, 0.0};  // in the wall, near A
  landmark.access = Pose2{1.35, 0.95, 0.0};    // on the far side of it
  const LandmarkId beyond = world.graph.add(landmark);
  landmark = {};
  landmark.T_map_landmark = {0.05, 0.3, 0.0};  // in the wall, near C, without an access
  const LandmarkId below = world.graph.add(landmark);
  PathRequest request = world.request('A', 'B', 0.12);
  request.to = {};
  request.to.landmarks = {beyond, below};
  const PathResult result = plan(world, request);
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_EQ(result.from_landmark, 0) << "a pose";
  EXPECT_EQ(result.to_landmark, below);
  request.to.landmarks = {99};
  EXPECT_EQ(plan(world, request).outcome, PlanOutcome::unknown_place);
}

// That the nearer one cannot be reached shows only on a lattice finer than the grid: a door of 0.5 m, a disc of 0.54 m.
TEST(OmplPlanner, AGoalThatProvesOutOfReachWhileItIsSearchedForLeavesTheOthers) {
  for (const MotionKind kind : {MotionKind::holonomic, MotionKind::differential}) {
    auto world = drawn_world(
        "##############################################\n"
        "#............................................#\n"
        "#............................................#\n"
        "#............................................#\n"
        "#............................................#\n"
        "#............................................#\n"
        "#...................................D........#\n"
        "#............................................#\n"
        "#............................................#\n"
        "#............................................#\n"
        "#............................................#\n"
        "#...........###########......................#\n"
        "#...........#.........#......................#\n"
        "#...........#.........#......................#\n"
        "#.....................#......................#\n"
        "#.....................#......................#\n"
        "#....A...........C....#......................#\n"
        "#.....................#......................#\n"
        "#.....................#......................#\n"
        "#...........#.........#......................#\n"
        "#...........#.........#......................#\n"
        "#...........###########......................#\n"
        "#............................................#\n"
        "##############################################\n");
    Landmark landmark;
    landmark.access = world.pose('C');
    landmark.T_map_landmark = world.pose('C');
    const LandmarkId behind = world.graph.add(landmark);
    landmark.access = world.pose('D');
    landmark.T_map_landmark = world.pose('D');
    const LandmarkId far = world.graph.add(landmark);
    PathRequest request = world.request('A', 'D', 0.27);
    request.to = {};
    request.to.landmarks = {behind};
    OmplConfig config;
    config.kinematics = kind;
    const PathResult narrow = plan(world, request, config);
    ASSERT_EQ(narrow.outcome, PlanOutcome::no_route) << narrow.reason;
    EXPECT_THAT(narrow.reason, HasSubstr("too narrow"));
    request.to.landmarks = {behind, far};
    const PathResult result = plan(world, request, config);
    ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
    EXPECT_EQ(result.to_landmark, far);
  }
}

// The route may not be much longer than the best over the cells, on rooms full of boxes.
TEST(OmplPlanner, RoutesAreNotMuchLongerThanTheShortest) {
  std::mt19937_64 random(1);
  int solved = 0;
  double sum_ratio = 0.0;
  for (int trial = 0; trial < 15; ++trial) {
    auto world = drawn_world(std::string(40, '.') + "\n");
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) world.grid.set_log_odds({x, y}, LogOdds{-900});
    for (int box = 0; box < 12; ++box) {
      const Cell low{4 + static_cast<int>(random() % 30), static_cast<int>(random() % 36)};
      for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 3; ++x) world.grid.set_log_odds(low + Cell{x, y}, LogOdds{900});
    }
    PathRequest request;
    request.from.pose = Pose2{0.25, 0.25, 0.0};
    request.to.pose = Pose2{3.75, 3.75, 0.0};
    request.radius_m = 0.12;
    const DiscSpace space(world.grid, {});
    const std::vector<Cell> cells = TravelField(space.field(), {0.25, 0.25}, 0.17).path_to({37, 37});
    std::vector<Point> over_cells;
    for (const Cell cell : cells) over_cells.push_back(space.field().centre_of(cell));
    const PathResult result = plan(world, request);
    const double over_cells_m = length_of(over_cells);
    if (over_cells.empty()) continue;
    ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
    EXPECT_LT(result.length_m, 1.0001 * over_cells_m) << test::drawing_of(world.grid, result.path);
    sum_ratio += result.length_m / over_cells_m;
    ++solved;
  }
  EXPECT_LT(sum_ratio / solved, 0.99) << "at any angle it is shorter than over neighbours";
  EXPECT_GT(solved, 5);
}

}  // namespace
}  // namespace cairn
