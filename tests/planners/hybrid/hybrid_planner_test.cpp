#include "planners/hybrid/hybrid_planner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/planners/hybrid/hybrid_world.hpp"

namespace cairn {
namespace {

using test::Hybrid;
using test::kRadius_m;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST_F(Hybrid, PassesLandmarksByAStoredRouteWithoutPlanningAnything) {
  const LandmarkId m = landmark('M');
  const LandmarkId n = landmark('N');
  const RouteId stored = route(m, n, "MN");
  const PlanResult result = plan(request('A', 'B'));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.landmarks, ElementsAre(m, n));
  EXPECT_THAT(result.routes, ElementsAre(stored));
  EXPECT_THAT(result.blocked_routes, IsEmpty());
  EXPECT_EQ(router->calls, 0) << result.reason;
  EXPECT_EQ(result.path.front().position(), world.places['A']);
  EXPECT_EQ(result.path.back().position(), world.places['B']);
  EXPECT_GT(result.settled, 0);
  expect_clear(result);
}

TEST_F(Hybrid, CutsCornersWhereTheGroundIsFree) {
  route(landmark('M'), landmark('N'), "MN");
  const PlanResult cut = plan(request('A', 'B'));
  EXPECT_EQ(cut.path.size(), 2U) << test::drawing_of(world.grid, cut.path);
  config.shortcut = false;
  EXPECT_EQ(plan(request('A', 'B')).path.size(), 4U);
}

TEST_F(Hybrid, ABlockedLegClosesItsRouteAndTheLandmarksAreSearchedAgain) {
  const LandmarkId m = landmark('M');
  const LandmarkId n = landmark('N');
  const LandmarkId p = landmark('P');
  const LandmarkId q = landmark('Q');
  const RouteId upper = route(m, n, "MUN");
  const RouteId down = route(m, p, "", 0.8);
  const RouteId lower = route(p, q, "PVQ");
  const RouteId up = route(q, n, "", 0.8);
  config.detour_ratio = 2.0;  // legs by free travel as well
  EXPECT_THAT(plan(between(m, n)).routes, ElementsAre(upper));
  for (const int dx : {0, 1})
    for (int dy = -2; dy <= 3; ++dy) world.grid.set_log_odds(world.grid.cell_at(world.places['U']) + Cell{dx, dy}, 900);

  const PlanResult result = plan(between(m, n));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.blocked_routes, ElementsAre(upper));
  EXPECT_THAT(result.routes, ElementsAre(down, lower, up));
  EXPECT_THAT(result.landmarks, ElementsAre(m, p, q, n));
  EXPECT_THAT(result.reason, HasSubstr("route R1 (M to N) is blocked"));
  expect_clear(result);
  EXPECT_FALSE(world.graph.find_route(upper)->closed) << "the graph itself is the host's";
}

TEST_F(Hybrid, GoesDirectlyWhenEveryRouteIsBlocked) {
  const LandmarkId m = landmark('M');
  const LandmarkId n = landmark('N');
  const RouteId upper = route(m, n, "MN");
  for (int dy = -2; dy <= 3; ++dy) world.grid.set_log_odds(world.grid.cell_at(world.places['U']) + Cell{0, dy}, 900);
  const PlanResult result = plan(between(m, n));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.routes, IsEmpty());
  EXPECT_THAT(result.landmarks, ElementsAre(m, n));
  EXPECT_GT(result.length_m, 2.0) << "through the other corridor";
  expect_clear(result);
  (void)upper;
}

TEST_F(Hybrid, ALegWithoutATrajectoryIsPlanned) {
  const LandmarkId m = landmark('M');
  const LandmarkId q = landmark('Q');
  const RouteId bare = route(m, q, "", 2.2);
  const PlanResult result = plan(between(m, q));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.routes, ElementsAre(bare));
  EXPECT_GE(router->calls, 1);
  EXPECT_THAT(result.reason, HasSubstr("1 newly planned leg"));
  expect_clear(result);
}

TEST_F(Hybrid, GoesDirectlyWhenLandmarksWouldBeADetour) {
  const LandmarkId p = landmark('P');
  const LandmarkId q = landmark('Q');
  route(p, q, "PVQ");
  const PlanResult result = plan(request('A', 'B'));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.landmarks, IsEmpty());
  EXPECT_THAT(result.reason, HasSubstr("directly"));
  EXPECT_NEAR(result.length_m, 2.3, 0.01);
}

TEST_F(Hybrid, GoesDirectlyWithoutAGraph) {
  const PlanResult result = plan(request('C', 'B'));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_EQ(router->calls, 1);
  EXPECT_EQ(searcher->calls, 0);
  expect_clear(result);
}

TEST_F(Hybrid, FromALandmarkToTheNearestOfSeveral) {
  const LandmarkId m = landmark('M');
  const LandmarkId n = landmark('N');
  const LandmarkId p = landmark('P');
  route(m, n, "MN");
  route(m, p, "", 0.8);
  PlanRequest both = between(m, n);
  both.to.landmarks.push_back(p);
  EXPECT_THAT(plan(both).landmarks, ElementsAre(m, p));
  EXPECT_THAT(plan(between(m, m)).landmarks, ElementsAre(m));
  EXPECT_EQ(plan(between(m, m)).length_m, 0.0);
}

TEST_F(Hybrid, BetweenLandmarksTheCostIsThatOfTheGraph) {
  const LandmarkId m = landmark('M');
  const LandmarkId n = landmark('N');
  route(m, n, "MUN", 1.42);
  const PlanResult result = plan(between(m, n));
  EXPECT_DOUBLE_EQ(result.cost_m, 1.42);
  EXPECT_NEAR(result.length_m, 1.3, 1e-9);
}

TEST_F(Hybrid, WhatCannotBeReachedIsAnOutcomeWithASentence) {
  landmark('M');
  PlanRequest away = request('A', 'B');
  for (int y = 0; y < 17; ++y) world.grid.set_log_odds({14, y}, 900);
  EXPECT_EQ(plan(away).outcome, PlanOutcome::no_route);
  EXPECT_THAT(plan(away).reason, HasSubstr("cannot be reached"));
  away.to.pose = Pose2{0.05, 0.05, 0.0};
  EXPECT_EQ(plan(away).outcome, PlanOutcome::goal_blocked);
  EXPECT_THAT(plan(away).reason, HasSubstr("the nearest free place is"));
  away = request('A', 'C');
  away.from.pose = Pose2{0.05, 0.05, 0.0};
  EXPECT_EQ(plan(away).outcome, PlanOutcome::start_blocked);
  EXPECT_EQ(plan(between(1, 77)).outcome, PlanOutcome::unknown_place);
  EXPECT_EQ(plan({}).outcome, PlanOutcome::unknown_place);
}

TEST_F(Hybrid, AStartTooNearToAWallIsLeftFirst) {
  PlanRequest tight = request('A', 'B');
  tight.from.pose = Pose2{0.19, 1.3, 0.0};
  const PlanResult result = plan(tight);
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_EQ(result.path.front().position(), tight.from.pose->position());
  EXPECT_THAT(result.reason, HasSubstr("less clearance"));
}

TEST_F(Hybrid, OnAMapWithoutAGridTheGraphAnswers) {
  const LandmarkId m = landmark('M');
  const LandmarkId n = landmark('N');
  route(m, n, "MN");
  world.grid = OccupancyGrid(0.1);
  const PlanResult result = plan(between(m, n));
  EXPECT_EQ(result.outcome, PlanOutcome::solved);
  EXPECT_EQ(result.path.size(), 2U);
  EXPECT_EQ(router->calls, 0);
  PlanRequest poses = request('A', 'B');
  EXPECT_EQ(plan(poses).outcome, PlanOutcome::unsupported);
}

TEST_F(Hybrid, KeepsToItsBudget) {
  route(landmark('M'), landmark('N'), "MN");
  const std::atomic<bool> cancel{true};
  Budget cancelled;
  cancelled.cancel = &cancel;
  EXPECT_EQ(plan(request('A', 'B'), cancelled).outcome, PlanOutcome::cancelled);
  Budget late;
  late.deadline = Budget::Clock::time_point::min();
  EXPECT_EQ(plan(request('A', 'B'), late).outcome, PlanOutcome::out_of_budget);
  Budget none;
  none.iterations = 0;
  EXPECT_EQ(plan(request('A', 'B'), none).outcome, PlanOutcome::out_of_budget);
}

TEST_F(Hybrid, ThePathPlannersPolicyOnUnknownSpaceHoldsForStoredRoutesToo) {
  const LandmarkId m = landmark('M');
  const LandmarkId n = landmark('N');
  const RouteId stored = route(m, n, "MUN");
  for (int dy = -2; dy <= 3; ++dy)
    world.grid.set_log_odds(world.grid.cell_at(world.places['U']) + Cell{0, dy}, 0);  // unknown right across
  EXPECT_THAT(plan(between(m, n)).blocked_routes, ElementsAre(stored));
  for (const UnknownGround unknown : {UnknownGround::allow, UnknownGround::cost}) {
    OmplConfig crossing;
    crossing.unknown = unknown;
    router = test::counted_ompl(crossing);
    const PlanResult result = plan(between(m, n));
    EXPECT_THAT(result.routes, ElementsAre(stored)) << result.reason;
    EXPECT_THAT(result.blocked_routes, IsEmpty());
  }
}

// Random worlds and graphs: whatever happens, an answer is never unsafe and never differs from itself.
TEST_F(Hybrid, TheRoutersMarginHoldsForStoredRoutesAndCutCornersToo) {
  route(landmark('M'), landmark('N'), "MUN");  // 0.15 m from the wall
  const auto stored = [](const PlanResult& result) {
    return std::any_of(result.segments.begin(), result.segments.end(),
                       [](const PathSegment& piece) { return piece.origin == PathSegment::Origin::stored; });
  };
  EXPECT_TRUE(stored(plan(request('M', 'N'))));
  const auto with_margin = [&](double margin_m) {
    OmplConfig wide;
    wide.margin_m = margin_m;
    router = test::counted_ompl(wide);
  };
  with_margin(0.005);
  EXPECT_TRUE(stored(plan(request('M', 'N'))));
  with_margin(0.03);
  EXPECT_FALSE(stored(plan(request('M', 'N'))));
  for (const double y_m : {0.3, 0.65, 1.0, 1.4}) {
    PlanRequest across = request('A', 'B');
    across.from.pose = Pose2{0.45, 1.0, 0.0};
    across.to.pose = Pose2{2.4, y_m, 0.0};
    const PlanResult result = plan(across);
    ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
    EXPECT_GE(test::distance_by_brute_force(world.grid, result.path, false, 0.01), kRadius_m + 0.03 - 1e-9) << y_m;
    EXPECT_GE(result.clearance_m, 0.03 - 1e-9) << "counted from the robot itself";
  }
  with_margin(0.1);
  PlanRequest across = request('A', 'B');
  across.from.pose = Pose2{0.45, 1.0, 0.0};
  across.to.pose = Pose2{2.4, 1.0, 0.0};
  EXPECT_EQ(plan(across).outcome, PlanOutcome::no_route) << "no corridor is so wide";
}

TEST_F(Hybrid, AnswersAreSafeAndRepeatableOnRandomWorlds) {
  config.detour_ratio = 2.0;
  int solved = 0;
  int over_landmarks = 0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    std::mt19937_64 random(seed);
    const auto cell = [&] { return Cell{2 + static_cast<int>(random() % 36), 2 + static_cast<int>(random() % 36)}; };
    world.grid = OccupancyGrid(0.1);
    world.graph = {};
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) world.grid.set_log_odds({x, y}, LogOdds{-900});
    for (int k = 0; k < 25; ++k) world.grid.set_log_odds(cell(), random() % 3 == 0 ? LogOdds{0} : LogOdds{900});
    std::vector<LandmarkId> ids;
    for (int k = 0; k < 8; ++k) {
      Landmark landmark;
      const Point at = world.grid.centre_of(cell());
      landmark.T_map_landmark = {at.x(), at.y(), 0.0};
      if (random() % 2 == 0) landmark.access = landmark.T_map_landmark;
      ids.push_back(world.graph.add(landmark));
    }
    for (int k = 0; k < 24; ++k) {
      Route route;
      route.from = ids[random() % 8];
      route.to = ids[random() % 8];
      const Pose2 a = world.graph.find(route.from)->T_map_landmark;
      const Pose2 b = world.graph.find(route.to)->T_map_landmark;
      if (random() % 2 == 0) route.trajectory = {a, b};
      route.cost_m = (a.position() - b.position()).norm();
      world.graph.add_route(route);
    }
    PlanRequest request;
    const Point from = world.grid.centre_of(cell());
    const Point to = world.grid.centre_of(cell());
    request.from.pose = Pose2{from.x(), from.y(), 0.0};
    request.to.pose = Pose2{to.x(), to.y(), 0.0};
    request.radius_m = kRadius_m;
    if (seed % 3 == 0) request.to = {{}, false, {ids[0], ids[1]}};
    const PlanResult result = plan(request);
    EXPECT_EQ(result.path, plan(request).path);
    EXPECT_FALSE(result.reason.empty());
    if (result.outcome != PlanOutcome::solved) continue;
    ++solved;
    over_landmarks += !result.routes.empty();
    if (result.reason.find("less clearance") == std::string::npos) expect_clear(result);
  }
  EXPECT_GT(solved, 10);
  EXPECT_GT(over_landmarks, 2);
}

}  // namespace
}  // namespace cairn
