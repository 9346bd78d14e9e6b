// Paths over landmarks of a robot that is known: joined for driving time.

#include "planners/common/disc_space/driving_time.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maps/hierarchy/hierarchies.hpp"
#include "tests/planners/hybrid/hybrid_world.hpp"

namespace cairn {
namespace {

using test::kRadius_m;

class HybridDrivingTime : public test::Hybrid {
 protected:
  [[nodiscard]] PlanResult plan_known(const PlanRequest& request) const {
    WorldView view = world.view();
    view.speed_law = SpeedLaw{};
    const Hierarchies hierarchies(world.graph, {},
                                  {view.robot.max_v_mps, view.robot.max_w_radps, kRadius_m, &world.grid});
    view.hierarchies = &hierarchies;
    return HybridPlanner(config, router, searcher).plan(request, view, {});
  }
  [[nodiscard]] double seconds_of(const PlanResult& result) const {
    WorldView view = world.view();
    view.speed_law = SpeedLaw{};
    const DiscSpace space(world.grid, GroundRules{});
    std::vector<Point> points;
    for (const Pose2& pose : result.path) points.push_back(pose.position());
    return driving_time_s(space.field(), points, *driving_rules_of(view, kRadius_m, 0.0));
  }
};

TEST_F(HybridDrivingTime, AccessLegsAndCutCornersKeepTheirDistanceWhereThereIsRoom) {
  const RouteId stored = route(landmark('M'), landmark('N'), "MUN");
  config.detour_ratio = 3.0;
  for (const char from : {'A', 'C'}) {
    const PlanResult unknown = plan(request(from, 'B'));
    const PlanResult known = plan_known(request(from, 'B'));
    ASSERT_EQ(known.outcome, PlanOutcome::solved) << known.reason;
    EXPECT_THAT(known.routes, testing::ElementsAre(stored));
    EXPECT_LE(seconds_of(known), seconds_of(unknown) * (1.0 + 1e-9)) << test::drawing_of(world.grid, known.path);
    expect_clear(known);
  }
  const PlanResult from_c = plan_known(request('C', 'B'));
  EXPECT_LT(seconds_of(from_c), 0.98 * seconds_of(plan(request('C', 'B'))));
}

TEST_F(HybridDrivingTime, TheAnswerSaysHowLongItsPathTakes) {
  route(landmark('M'), landmark('N'), "MUN");
  for (const char to : {'B', 'D'}) {
    const PlanResult known = plan_known(request('A', to));
    ASSERT_TRUE(known.driving_time_s) << known.reason;
    EXPECT_NEAR(*known.driving_time_s, seconds_of(known), 1e-9);
    EXPECT_FALSE(plan(request('A', to)).driving_time_s);
  }
}

// The path planner's objective says what legs are joined for.
TEST_F(HybridDrivingTime, WithARoutePlannerForLengthsNothingChanges) {
  route(landmark('M'), landmark('N'), "MUN");
  OmplConfig shortest;
  shortest.objective = Objective::length;
  router = test::counted_ompl(shortest);
  for (const char from : {'A', 'C'}) EXPECT_EQ(plan_known(request(from, 'B')).path, plan(request(from, 'B')).path);
}

TEST_F(HybridDrivingTime, ALegThatIsLongerBecauseItIsFasterIsNotBlocked) {
  const LandmarkId a = landmark('A');
  const LandmarkId c = landmark('C');
  const RouteId leg = route(a, c, "");
  config.detour_ratio = 1.0;  // no longer than the straight line
  const PlanResult known = plan_known(between(a, c));
  ASSERT_EQ(known.outcome, PlanOutcome::solved) << known.reason;
  EXPECT_THAT(known.routes, testing::ElementsAre(leg));
  EXPECT_THAT(known.blocked_routes, testing::IsEmpty());
}

TEST_F(HybridDrivingTime, ByTimeTheDirectPathIsTakenWhereItIsFaster) {
  route(landmark('M'), landmark('N'), "MACPVQDBN");
  config.detour_ratio = 10.0;
  PlanRequest asked = request('A', 'B');
  const PlanResult by_length = plan_known(asked);
  asked.cost = CostKind::time;
  const PlanResult by_time = plan_known(asked);
  ASSERT_TRUE(by_time.driving_time_s) << by_time.reason;
  EXPECT_LE(*by_time.driving_time_s, *by_length.driving_time_s * (1.0 + 1e-9)) << by_time.reason;
  EXPECT_THAT(by_time.reason, testing::StartsWith("directly: over landmarks it takes"));
}

// They hold on routes alone.
TEST_F(HybridDrivingTime, ByTimeNoSpeedLimitIsAvoidedByGoingDirectly) {
  Route slow;
  slow.from = landmark('M');
  slow.to = landmark('N');
  for (const char place : {'M', 'A', 'C', 'P', 'V', 'Q', 'D', 'B', 'N'}) slow.trajectory.push_back(world.pose(place));
  slow.cost_m = length_of(slow.trajectory);
  slow.speed_limit_mps = 0.2;
  const RouteId limited = world.graph.add_route(slow);
  config.detour_ratio = 10.0;
  PlanRequest asked = request('A', 'B');
  asked.cost = CostKind::time;
  const PlanResult by_time = plan_known(asked);
  EXPECT_THAT(by_time.routes, testing::ElementsAre(limited)) << by_time.reason;
}

TEST_F(HybridDrivingTime, ByClearanceNoCornerIsPassedNearerThanWithoutCutting) {
  route(landmark('M'), landmark('N'), "MUN");
  config.detour_ratio = 3.0;
  for (const char from : {'A', 'C'}) {
    PlanRequest asked = request(from, 'B');
    asked.cost = CostKind::clearance;
    config.shortcut = true;
    const PlanResult known = plan_known(asked);
    const PlanResult unknown = plan(asked);
    config.shortcut = false;
    EXPECT_GE(known.clearance_m, plan_known(asked).clearance_m - 1e-9);
    EXPECT_GE(unknown.clearance_m, plan(asked).clearance_m - 1e-9) << "of a robot that is not known";
  }
}

}  // namespace
}  // namespace cairn
