// Paths over landmarks of a robot that is known: joined for driving time.

#include "planners/common/disc_space/driving_time.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planners/hybrid/hybrid_world.hpp"

namespace cairn {
namespace {

using test::kRadius_m;

class HybridDrivingTime : public test::Hybrid {
 protected:
  [[nodiscard]] PlanResult plan_known(const PlanRequest& request) const {
    WorldView view = world.view();
    view.speed_law = SpeedLaw{};
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

}  // namespace
}  // namespace cairn
