#include "plugins/behaviours/errands/await_orders.hpp"

#include <gmock/gmock.h>

#include "tests/plugins/behaviours/fake_host.hpp"
#include "tests/plugins/behaviours/written_config.hpp"

namespace cairn::behaviours {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::string kRoom = R"(
  ############################
  #..........................#
  #..........................#
  #..........................#
  #..........................#
  #..........................#
  #....R.....................#
  #..........................#
  #..........................#
  #..........................#
  #..........................#
  #..........................#
  ############################
)";

class AwaitOrdersTest : public testing::Test {
 protected:
  AwaitOrdersTest() { host_.graph.add(landmark_at("square", {2.5, 0.6, 0.0}, {2.1, 0.6, 0.0}, "office")); }
  void order(const std::string& kind, const std::string& settings) {
    ConfigValue value = parse_config_text(settings, "order");
    host_.orders.push_back({kind, value, "{" + kind + ": " + settings + "}"});
  }
  Status tick() { return host_.tick(step_); }
  [[nodiscard]] double to(double x_m, double y_m) const {
    return (host_.T_map_robot.position() - Point(x_m, y_m)).norm();
  }

  FakeHost host_{kRoom, {.all_known = true}};
  AwaitOrders step_{AwaitOrdersConfig{}, 1};
};

TEST_F(AwaitOrdersTest, StandsUntilAnOrderComes) {
  const Pose2 before = host_.T_map_robot;
  EXPECT_EQ(host_.run(step_, 5.0).state, StepState::running);
  EXPECT_EQ(host_.T_map_robot, before);
  EXPECT_EQ(tick().reason, "waiting for orders");
}

TEST_F(AwaitOrdersTest, TakesOrdersWhileTheRobotIsStoppedAndCarriesThemOutAfterwards) {
  host_.observe = [](const FakeHost& host) {
    Observation seen;
    if (host.time_s < 60.0) seen.stopped_by = "the red button";
    return seen;
  };
  order("goto", "[2.1, 0.6]");
  EXPECT_THAT(tick().reason, HasSubstr("waits: the robot is stopped by the red button"));
  EXPECT_EQ(host_.answers.at(0).state, StepState::success);
  const Pose2 before = host_.T_map_robot;
  EXPECT_EQ(host_.run(step_, 50.0).state, StepState::running);
  EXPECT_EQ(host_.T_map_robot, before);
  EXPECT_EQ(host_.run(step_, 60.0).state, StepState::running);
  EXPECT_LT(to(2.1, 0.6), 0.25) << host_.picture();
}

// Ordered while the robot is stopped, so that its step is not ticked before the release.
TEST_F(AwaitOrdersTest, TheOrderedPlaceMovesWithAMapThatIsExchangedWhileTheRobotIsStopped) {
  std::string stopped_by = "the red button";
  host_.observe = [&](const FakeHost&) {
    Observation seen;
    seen.stopped_by = stopped_by;
    return seen;
  };
  order("goto", "[2.1, 0.6]");
  (void)tick();
  host_.move_map({1.0, 0.0});
  (void)tick();
  stopped_by.clear();
  (void)host_.run(step_, 60.0);
  EXPECT_LT(to(3.1, 0.6), 0.25) << host_.picture();
}

TEST_F(AwaitOrdersTest, AnOrderWhosePlaceIsLostWithTheMapFails) {
  std::string stopped_by;
  host_.observe = [&](const FakeHost&) {
    Observation seen;
    seen.stopped_by = stopped_by;
    return seen;
  };
  order("goto", "[2.1, 0.6]");
  (void)host_.run(step_, 1.0);
  stopped_by = "the red button";
  (void)tick();
  host_.move_map({1.0, 0.0});
  host_.move_map({-0.5, 0.0});
  (void)tick();
  stopped_by.clear();
  EXPECT_EQ(tick().reason, "waiting for orders");
  EXPECT_THAT(
      host_.said,
      Contains(HasSubstr("failed: the map has been drawn anew, and where (2.10, 0.60) lies on it is not known")));
}

TEST_F(AwaitOrdersTest, GoesToThePlaceThatIsOrderedAndWaitsAgain) {
  order("goto", "[2.1, 0.6]");
  EXPECT_THAT(tick().reason, HasSubstr("order {goto: [2.1, 0.6]}: "));
  ASSERT_EQ(host_.answers.size(), 1U);
  EXPECT_EQ(host_.answers[0].state, StepState::success);
  EXPECT_EQ(host_.run(step_, 60.0).state, StepState::running);
  EXPECT_LT(to(2.1, 0.6), 0.25) << host_.picture();
  EXPECT_THAT(host_.said, Contains(HasSubstr("done: at (2.10, 0.60)")));
  EXPECT_EQ(tick().reason, "waiting for orders");
}

TEST_F(AwaitOrdersTest, ANewOrderTakesThePlaceOfTheOneUnderWay) {
  order("goto", "[2.2, 0.6]");
  (void)host_.run(step_, 1.0);
  order("goto", "[0.5, 0.8]");
  (void)tick();
  EXPECT_THAT(host_.answers.back().reason, HasSubstr("in place of {goto: [2.2, 0.6]}"));
  (void)host_.run(step_, 60.0);
  EXPECT_LT(to(0.5, 0.8), 0.25) << host_.picture();
}

TEST_F(AwaitOrdersTest, StopEndsTheOrderUnderWay) {
  order("goto", "[2.2, 0.6]");
  (void)host_.run(step_, 1.0);
  order("stop", "{}");
  (void)tick();
  const Pose2 stopped = host_.T_map_robot;
  (void)host_.run(step_, 5.0);
  EXPECT_EQ(host_.T_map_robot, stopped);
  order("stop", "{}");
  (void)tick();
  EXPECT_EQ(host_.answers.back().reason, "nothing was under way");
}

TEST_F(AwaitOrdersTest, ANameIsGivenBesideTheOrderUnderWay) {
  order("goto", "[2.2, 0.6]");
  order("name", "{landmark: office, as: desk}");
  EXPECT_THAT(tick().reason, HasSubstr("goto"));
  EXPECT_NE(host_.graph.find_by_name("desk"), nullptr);
  EXPECT_EQ(host_.answers[1].state, StepState::success);
}

TEST_F(AwaitOrdersTest, APlaceThatTheMapDoesNotHoldIsRefusedWithTheNearestName) {
  order("goto", "ofice");
  EXPECT_EQ(tick().state, StepState::running) << "the mission goes on";
  EXPECT_EQ(host_.answers[0].state, StepState::failure);
  EXPECT_THAT(host_.answers[0].reason, HasSubstr("no landmark \"ofice\" (did you mean \"office\"?)"));
  order("return_home", "nowhere");
  (void)tick();
  EXPECT_THAT(host_.answers[1].reason, HasSubstr("no landmark \"nowhere\""));
  order("goto", "{landmrk: office}");
  (void)tick();
  EXPECT_THAT(host_.answers[2].reason, HasSubstr("(did you mean \"landmark\"?)"));
  EXPECT_EQ(tick().reason, "waiting for orders");
}

TEST_F(AwaitOrdersTest, ARefusedOrderLeavesTheOneUnderWay) {
  order("goto", "[2.1, 0.6]");
  (void)tick();
  order("goto", "nowhere");
  EXPECT_THAT(tick().reason, HasSubstr("order {goto: [2.1, 0.6]}: "));
}

TEST_F(AwaitOrdersTest, AnOrderThatFailsEndsItselfOnly) {
  host_.planner = [](const PlanRequest&) { return PlanResult{}; };
  order("goto", "{landmark: office, at_most_s: 1}");
  EXPECT_EQ(host_.run(step_, 20.0).state, StepState::running);
  EXPECT_THAT(host_.said, Contains(HasSubstr(" failed: ")));
  EXPECT_EQ(tick().reason, "waiting for orders");
}

TEST_F(AwaitOrdersTest, FinishEndsTheStepAndWhatComesBehindItIsRefused) {
  order("finish", "{}");
  order("stop", "{}");
  EXPECT_EQ(tick().state, StepState::success);
  EXPECT_EQ(host_.answers[0].state, StepState::success);
  EXPECT_EQ(host_.answers[1].state, StepState::failure);
  step_.halt();
  EXPECT_EQ(tick().reason, "waiting for orders") << "it begins afresh";
}

TEST_F(AwaitOrdersTest, EndsWhenNothingIsOrderedForLong) {
  AwaitOrders step(config_of<AwaitOrdersConfig>("5"), 1);
  const double begun_s = host_.time_s;
  EXPECT_EQ(host_.run(step, 60.0).state, StepState::success);
  EXPECT_NEAR(host_.time_s - begun_s, 5.0, 0.2);
}

}  // namespace
}  // namespace cairn::behaviours
