#include "planners/hybrid/avoided.hpp"

#include <gmock/gmock.h>

#include "tests/planners/hybrid/hybrid_world.hpp"

namespace cairn {
namespace {

using test::Hybrid;
using test::kRadius_m;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Avoided : public Hybrid {
 protected:
  // From M to N: by the upper corridor past U, or round by the lower one.
  void add_ways() {
    m = landmark('M');
    n = landmark('N');
    const LandmarkId p = landmark('P');
    const LandmarkId q = landmark('Q');
    upper = route(m, n, "MUN");
    round = {route(m, p, "", 1.2), route(p, q, "PVQ"), route(q, n, "", 1.2)};
  }
  double distance_to(char place, const PlanResult& result) const {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < result.path.size(); ++i)
      nearest_m = std::min(nearest_m, distance_to_square_m(result.path[i - 1].position(), result.path[i].position(),
                                                           world.places.at(place), 1e-9));
    return nearest_m;
  }

  LandmarkId m = 0, n = 0;
  RouteId upper = 0;
  std::vector<RouteId> round;
};

TEST_F(Avoided, TheDirectPathAvoidsApproachPoses) {
  const LandmarkId u = landmark('U');
  PlanRequest direct = request('A', 'B');
  EXPECT_LT(distance_to('U', plan(direct)), kRadius_m);
  direct.avoid = {u};
  const PlanResult result = plan(direct);
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_GE(distance_to('U', result), 2.0 * kRadius_m) << test::drawing_of(world.grid, result.path);
  expect_clear(result);
}

TEST_F(Avoided, ARouteThatPassesOneIsNotTakenAndNotCalledBlocked) {
  add_ways();
  const LandmarkId u = landmark('U');
  PlanRequest request = between(m, n);
  request.avoid = {u};
  const PlanResult result = plan(request);
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_EQ(result.routes, round) << "whatever the detour";
  EXPECT_THAT(result.blocked_routes, IsEmpty());
  EXPECT_THAT(result.reason, HasSubstr("route R1 (M to N) passes an avoided landmark"));
  EXPECT_GE(distance_to('U', result), 2.0 * kRadius_m) << test::drawing_of(world.grid, result.path);
  expect_clear(result);
}

TEST_F(Avoided, AClosedRouteLeavesTheWayOverOtherLandmarksWhateverTheDetour) {
  add_ways();
  PlanRequest request = between(m, n);
  EXPECT_THAT(plan(request).routes, ElementsAre(upper));
  request.closed = {upper};
  const PlanResult result = plan(request);
  EXPECT_EQ(result.routes, round) << result.reason;
  expect_clear(result);
}

TEST_F(Avoided, EndsMayBeAvoidedAndStoodAt) {
  add_ways();
  PlanRequest request = between(m, n);
  request.avoid = {m, n};
  EXPECT_THAT(plan(request).routes, ElementsAre(upper));
  const LandmarkId u = landmark('U');
  PlanRequest from_there = this->request('U', 'B');
  from_there.avoid = {u};
  EXPECT_EQ(plan(from_there).outcome, PlanOutcome::solved) << plan(from_there).reason;
}

TEST_F(Avoided, WithoutAnyOtherWayTheReasonSaysSo) {
  const LandmarkId u = landmark('U');
  const LandmarkId v = landmark('V');
  PlanRequest direct = request('A', 'B');
  direct.avoid = {u, v};
  const PlanResult result = plan(direct);
  EXPECT_EQ(result.outcome, PlanOutcome::no_route);
  EXPECT_THAT(result.reason, HasSubstr("the places of avoided landmarks count as blocked"));
  EXPECT_THAT(result.path, IsEmpty());
  for (int y = 0; y < 17; ++y) world.grid.set_log_odds({14, y}, 900);
  EXPECT_THAT(plan(request('A', 'B')).reason, Not(HasSubstr("avoided")));
}

TEST_F(Avoided, ACarKeepsOffToo) {
  const LandmarkId u = landmark('U');
  OmplConfig car;
  car.kinematics = MotionKind::dubins;
  car.turning_radius_m = 0.1;
  router = test::counted_ompl(car);
  PlanRequest direct = request('A', 'B');
  const PlanResult before = plan(direct);
  ASSERT_EQ(before.outcome, PlanOutcome::solved) << before.reason;
  EXPECT_LT(distance_to('U', before), kRadius_m);
  direct.avoid = {u};
  const PlanResult result = plan(direct);
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_GE(distance_to('U', result), 2.0 * kRadius_m) << test::drawing_of(world.grid, result.path);
  direct.avoid = {u, landmark('V')};
  EXPECT_THAT(plan(direct).reason, HasSubstr("the places of avoided landmarks count as blocked"));
  PlanRequest nowhere = direct;
  nowhere.from.pose->x_m = NAN;
  EXPECT_EQ(plan(nowhere).outcome, PlanOutcome::unknown_place);
}

TEST_F(Avoided, OneQuerysObstaclesAreNoneToTheNext) {
  const LandmarkId u = landmark('U');
  const HybridPlanner planner(config, router, searcher);
  PlanRequest direct = request('A', 'B');
  const PlanResult before = planner.plan(direct, world.view(), {});
  direct.avoid = {u};
  EXPECT_GT(planner.plan(direct, world.view(), {}).length_m, before.length_m);
  direct.avoid = {};
  EXPECT_EQ(planner.plan(direct, world.view(), {}).path, before.path);
}

TEST_F(Avoided, OnlyTheGroundUnderARobotThereIsBlocked) {
  const LandmarkId u = landmark('U');
  PlanRequest direct = request('A', 'B');
  direct.avoid = {u};
  const auto grid = with_avoided_blocked(world.view(), direct, DiscSpace(world.grid, {}), kRadius_m);
  ASSERT_TRUE(grid);
  const CellBox box = world.grid.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) {
      const Point at = world.places['U'];
      const bool under = distance_to_square_m(at, at, world.grid.centre_of({x, y}), 0.1) < kRadius_m;
      if (under)
        EXPECT_EQ(grid->state({x, y}), CellState::occupied) << x << ", " << y;
      else
        EXPECT_EQ(grid->log_odds({x, y}), world.grid.log_odds({x, y})) << x << ", " << y;
    }
  direct.avoid = {};
  EXPECT_FALSE(with_avoided_blocked(world.view(), direct, DiscSpace(world.grid, {}), kRadius_m));
}

}  // namespace
}  // namespace cairn
