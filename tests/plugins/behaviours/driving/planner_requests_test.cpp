#include "plugins/behaviours/driving/planner_requests.hpp"

#include <gmock/gmock.h>

#include "tests/plugins/behaviours/fake_host.hpp"

namespace cairn::behaviours {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::string kYard = R"(
  ######
  #....#
  #.R..#
  ######
)";

// Asks at a time; the planner answers with this outcome.
struct Asking : testing::Test {
  PlanResult ask(double time_s) {
    const WorldView world{host.grid, host.graph, host.robot, {host.T_map_robot, {}}, time_s};
    requests.tick(time_s);
    host.planned.clear();
    host.planner = [&](const PlanRequest&) { return answer; };
    return requests.ask(Place{Pose2{0.4, 0.2, 0.0}, false, {}}, world, host);
  }
  FakeHost host{kYard};
  PlannerRequests requests{{}, 7};
  PlanResult answer;
};

TEST_F(Asking, ForLessAndLessRoomUntilThereIsAPath) {
  (void)ask(0.0);
  std::vector<double> clearances_m;
  for (const PlanRequest& request : host.planned) clearances_m.push_back(request.radius_m - host.robot.radius_m);
  EXPECT_THAT(clearances_m, ElementsAre(testing::DoubleNear(0.12, 1e-9), testing::DoubleNear(0.06, 1e-9), 0.0));
  answer.outcome = PlanOutcome::solved;
  (void)ask(10.0);
  EXPECT_EQ(host.planned.size(), 1U);
}

TEST_F(Asking, WithoutClosedRoutesFirstAndWithThemWhenThereIsNoOtherPath) {
  requests.close(5, 0.0);
  (void)ask(1.0);
  ASSERT_EQ(host.planned.size(), 6U);
  EXPECT_THAT(host.planned.front().closed, ElementsAre(5));
  EXPECT_THAT(host.planned.back().closed, IsEmpty());
}

TEST_F(Asking, ClosedRoutesAreOpenAgainAfterAWhile) {
  requests.close(5, 0.0);
  (void)ask(61.0);
  EXPECT_THAT(host.planned.front().closed, IsEmpty());
}

TEST_F(Asking, NotMoreOftenThanItsSettingsSay) {
  EXPECT_TRUE(requests.may_plan(0.0));
  (void)ask(5.0);
  EXPECT_FALSE(requests.may_plan(5.9));
  EXPECT_TRUE(requests.may_plan(6.0));
  EXPECT_FALSE(requests.may_plan_locally(7.9));
  EXPECT_EQ(requests.plans(), 1);
}

}  // namespace
}  // namespace cairn::behaviours
