#include "planners/hybrid/windows/local_query.hpp"

#include <gmock/gmock.h>

#include "tests/planners/drawn_world.hpp"
#include "tests/planners/hybrid/rooms_world.hpp"

namespace cairn {
namespace {

using test::CountedCells;
using test::LocalAsker;
using test::RoomsWorld;

constexpr double kRadius_m = LocalAsker::kRadius_m;

// Of a question whose ends lie in the same rooms of buildings of any size.
struct Looked {
  PlanResult result;
  std::size_t tiles = 0;
};

Looked looked_at(const RoomsWorld& whole, const LocalAsker& asker, const PlanRequest& request) {
  OccupancyGrid read(whole.grid.cell_m(), whole.grid.clamp_nat(), whole.grid.origin_m());
  read.include(whole.grid.bounds());
  const CountedCells cells(whole.grid, read);
  WorldView world{read, whole.graph, whole.robot, {}, 0.0};
  world.grid_version = 1;
  world.cells = &cells;
  auto answer = asker.answer(request, world);
  EXPECT_TRUE(answer.result) << answer.why_none;
  return {answer.result.value_or(PlanResult{}), cells.tiles()};
}

std::vector<Point> points_on(const std::vector<Pose2>& path) {
  std::vector<Point> points;
  for (const Pose2& pose : path) points.push_back(pose.position());
  return points;
}

TEST(LocalQuery, WhatIsLookedAtDoesNotGrowWithTheArea) {
  std::vector<std::size_t> tiles;
  std::vector<std::vector<Pose2>> paths;
  for (const int rooms : {8, 16, 24}) {
    const RoomsWorld world(rooms);
    const LocalAsker asker;
    const Looked looked = looked_at(
        world, asker, LocalAsker::between(world.middle_of({1, 1}), world.middle_of({4, 3}) + Point(0.5, 0.7)));
    ASSERT_EQ(looked.result.outcome, PlanOutcome::solved) << looked.result.reason;
    tiles.push_back(looked.tiles);
    paths.push_back(looked.result.path);
  }
  EXPECT_EQ(tiles[0], tiles[1]);
  EXPECT_EQ(tiles[1], tiles[2]);
  EXPECT_LT(tiles[2], 40U) << "of 225 tiles of the largest";
  EXPECT_EQ(paths[0], paths[1]);
  EXPECT_EQ(paths[1], paths[2]);
}

TEST(LocalQuery, BetweenLandmarksOnlyTilesBesideTheRoutesAreLookedAt) {
  const RoomsWorld world(24);
  PlanRequest request;
  request.from.landmarks = {world.landmark_in.at({0, 0})};
  request.to.landmarks = {world.landmark_in.at({23, 0})};
  request.radius_m = kRadius_m;
  const Looked looked = looked_at(world, LocalAsker(), request);
  ASSERT_EQ(looked.result.outcome, PlanOutcome::solved) << looked.result.reason;
  EXPECT_THAT(looked.result.reason, testing::HasSubstr("by 23 stored and 0 newly planned legs"));
  EXPECT_LE(looked.tiles, 30U) << "of 225";
}

TEST(LocalQuery, GivesFreePathsThatAreHardlyLongerThanTheShortest) {
  const RoomsWorld world(10);
  const LocalAsker asker;
  const DiscRoutes shortest(std::make_shared<const DiscSpace>(world.grid, GroundRules{}), kRadius_m + kMinRadius_m);
  std::mt19937_64 random(5);
  double ratio_sum = 0.0;
  constexpr int kPairs = 40;
  for (int i = 0; i < kPairs; ++i) {
    const Point from = world.any_place(random, kRadius_m);
    const Point to = world.any_place(random, kRadius_m);
    const LocalAnswer answer = asker.answer(LocalAsker::between(from, to), world.view());
    ASSERT_TRUE(answer.result) << answer.why_none;
    ASSERT_EQ(answer.result->outcome, PlanOutcome::solved) << answer.result->reason;
    EXPECT_EQ(answer.result->path.front().position(), from);
    EXPECT_EQ(answer.result->path.back().position(), to);
    const DiscRoute best = shortest.coarse_route(from, to, {});
    ASSERT_FALSE(best.route.empty());
    EXPECT_GE(answer.result->length_m, best.length_lower_bound_m - 1e-6);
    if (answer.result->length_lower_bound_m) {
      EXPECT_LE(*answer.result->length_lower_bound_m, length_of(best.route) + 1e-6);
    }
    ratio_sum += answer.result->length_m / length_of(best.route);
    const std::vector<Point> points = points_on(answer.result->path);
    EXPECT_TRUE(route_is_free(world.grid, {}, points, kRadius_m));
    EXPECT_NEAR(answer.result->clearance_m, clearance_along(shortest.space(), points, kRadius_m), 1e-6);
  }
  EXPECT_LT(ratio_sum / kPairs, 1.05);
}

// Rooms that are closed, doors that are, and things anywhere.
TEST(LocalQuery, SolvesWhatTheWholeGridSolvesOrLeavesItToThat) {
  std::mt19937_64 random(11);
  int solved = 0;
  int left = 0;
  for (int trial = 0; trial < 30; ++trial) {
    RoomsWorld world(5);
    const auto any_room = [&] { return Cell{static_cast<int>(random() % 5), static_cast<int>(random() % 5)}; };
    for (int i = static_cast<int>(random() % 5); i > 0; --i) world.close_doors_of(any_room());
    for (int i = static_cast<int>(random() % 30); i > 0; --i) {
      const Cell at{static_cast<int>(random() % 195), static_cast<int>(random() % 195)};
      world.fill(at, at + Cell{6, 6}, random() % 3 == 0 ? 0 : 900);
    }
    const LocalAsker asker;
    const DiscRoutes whole(std::make_shared<const DiscSpace>(world.grid, GroundRules{}), kRadius_m);
    for (int pair = 0; pair < 4; ++pair) {
      const PlanRequest request =
          LocalAsker::between(world.any_place(random, kRadius_m), world.any_place(random, kRadius_m));
      const LocalAnswer local = asker.answer(request, world.view());
      if (!local.result) {
        ++left;
        EXPECT_FALSE(local.why_none.empty());
        continue;
      }
      ++solved;
      EXPECT_EQ(local.result->outcome, PlanOutcome::solved) << local.result->reason;
      const std::vector<Point> points = points_on(local.result->path);
      EXPECT_TRUE(whole.may_reach(points.front(), points.back()));
      EXPECT_TRUE(route_is_free(world.grid, {}, points, kRadius_m));
      if (solved % 16 == 0) {
        EXPECT_GE(test::distance_by_brute_force(world.grid, local.result->path, false, 0.1), kRadius_m - 1e-9);
      }
    }
  }
  EXPECT_GT(solved, 60);
  EXPECT_GT(left, 5) << "some cannot be solved";
}

TEST(LocalQuery, ABlockedRouteIsNamedAndPassedRound) {
  RoomsWorld world(6);
  const Cell a{1, 1};
  const Cell b{2, 1};
  const RouteId blocked = world.route_between.at({world.landmark_in[a], world.landmark_in[b]});
  const Cell wall{2 * RoomsWorld::kRoom_cells, RoomsWorld::kRoom_cells};
  world.fill(wall, wall + Cell{1, RoomsWorld::kRoom_cells}, 900);
  PlanRequest request;
  request.from.landmarks = {world.landmark_in[a]};
  request.to.landmarks = {world.landmark_in[b]};
  request.radius_m = kRadius_m;
  LocalAsker asker;
  asker.windows.near_m = 0.0;
  const LocalAnswer answer = asker.answer(request, world.view());
  ASSERT_TRUE(answer.result) << answer.why_none;
  ASSERT_EQ(answer.result->outcome, PlanOutcome::solved) << answer.result->reason;
  EXPECT_EQ(answer.result->blocked_routes, std::vector{blocked});
  EXPECT_EQ(answer.result->routes.size(), 3U);
}

TEST(LocalQuery, NearEndsAreJoinedDirectlyWhereLandmarksWouldBeADetour) {
  const RoomsWorld world(6);
  const Point corner = world.middle_of({2, 2}) + Point(-1.0, -1.0);
  const LocalAsker asker;
  const LocalAnswer answer = asker.answer(LocalAsker::between(corner, corner + Point(0.0, 0.8)), world.view());
  ASSERT_TRUE(answer.result);
  EXPECT_THAT(answer.result->reason, testing::StartsWith("directly"));
  EXPECT_NEAR(answer.result->length_m, 0.8, 1e-9);
}

TEST(LocalQuery, BlockedEndsAreRefusedAsByTheWholeGrid) {
  const RoomsWorld world(6);
  const LocalAsker asker;
  const Point free = world.middle_of({1, 1});
  for (const Point& blocked : {Point(0.05, 0.05), Point(-3.0, 2.0), Point(8.02, 1.0)}) {
    for (const bool start : {true, false}) {
      PlanRequest request = start ? LocalAsker::between(blocked, free) : LocalAsker::between(free, blocked);
      const LocalAnswer local = asker.answer(request, world.view());
      const PlanResult whole = asker.whole(request, world.view());
      ASSERT_TRUE(local.result);
      EXPECT_EQ(local.result->outcome, whole.outcome);
      EXPECT_EQ(local.result->reason, whole.reason);
    }
  }
}

TEST(LocalQuery, WithoutLandmarksWithinReachTheWholeGridIsLeftToSay) {
  RoomsWorld world(6);
  world.close_doors_of({4, 4});
  const LocalAnswer answer =
      LocalAsker().answer(LocalAsker::between(world.middle_of({0, 0}), world.middle_of({4, 4})), world.view());
  EXPECT_FALSE(answer.result);
  EXPECT_FALSE(answer.why_none.empty());
  world.graph = {};
  const LocalAnswer none =
      LocalAsker().answer(LocalAsker::between(world.middle_of({0, 0}), world.middle_of({3, 3})), world.view());
  EXPECT_FALSE(none.result);
  EXPECT_EQ(none.why_none, "no landmark with routes is reached near the start");
}

TEST(LocalQuery, OfSeveralGoalsTheNearestOverTheGraphIsTaken) {
  const RoomsWorld world(8);
  PlanRequest request;
  request.from.landmarks = {world.landmark_in.at({0, 0})};
  request.to.landmarks = {world.landmark_in.at({7, 7}), world.landmark_in.at({3, 0}), world.landmark_in.at({0, 6})};
  request.radius_m = kRadius_m;
  const LocalAnswer answer = LocalAsker().answer(request, world.view());
  ASSERT_TRUE(answer.result);
  EXPECT_EQ(answer.result->landmarks.back(), world.landmark_in.at({3, 0}));
}

}  // namespace
}  // namespace cairn
