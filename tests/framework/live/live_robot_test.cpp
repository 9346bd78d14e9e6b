#include "framework/live/live_robot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "framework/live/steady_time.hpp"
#include "framework/live/velocity_orders.hpp"

namespace cairn::live {
namespace {

using testing::HasSubstr;

// A base that says what it is told to, and remembers what was sent.
struct FakeBase {
  std::atomic<bool> is_there{true};
  std::atomic<bool> is_gone{false};
  std::atomic<bool> is_silent{false};
  std::atomic<bool> is_mad{false};
  std::atomic<double> sent_v_mps{0.0};
  std::atomic<int> sent{0};
  std::atomic<int> pulses{0};
  std::atomic<int> stops{0};
  std::atomic<bool> stops_by_the_sender{false};
  std::atomic<int> connections{0};
};

class FakeLink final : public BaseLink {
 public:
  explicit FakeLink(FakeBase& base) : base_(base) {}
  [[nodiscard]] std::string name() const override { return "the fake"; }
  [[nodiscard]] bool connect(const Budget&, std::string& why) override {
    why = "it is off";
    if (base_.is_there) ++base_.connections;
    return base_.is_there;
  }
  void disconnect() override {}
  [[nodiscard]] bool receive(std::vector<Observation>& seen) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (base_.is_mad) throw std::runtime_error("speaks in tongues");
    if (base_.is_silent) return true;
    seen.emplace_back();
    seen.back().stamp_s = now_s();
    return !base_.is_gone.exchange(false);
  }
  void send(const Twist& twist) noexcept override {
    base_.sent_v_mps = twist.v_mps;
    ++base_.sent;
  }
  void send_pulse() noexcept override { ++base_.pulses; }
  bool send_stop() noexcept override {
    ++base_.stops;
    if (base_.stops_by_the_sender) return false;
    base_.sent_v_mps = 0.0;
    return true;
  }

 private:
  FakeBase& base_;
};

class LiveRobots : public testing::Test {
 protected:
  [[nodiscard]] std::unique_ptr<LiveRobot> made(LiveRules rules = {}) {
    return std::make_unique<LiveRobot>(std::make_unique<FakeLink>(base), rules, RobotModel{});
  }
  static void drive(LiveRobot& robot, double for_s, double v_mps = 0.2) {
    for (const double begin_s = now_s(); now_s() - begin_s < for_s;) {
      ASSERT_EQ(robot.next({}).state, SensorState::observation);
      robot.command({v_mps, 0.0}, 1.0);
    }
  }
  [[nodiscard]] bool stands_within(double within_s) const {
    for (const double begin_s = now_s(); now_s() - begin_s < within_s;) {
      if (base.sent_v_mps == 0.0) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }

  FakeBase base;
};

TEST_F(LiveRobots, SpeedUpAsTheirFileAllowsAndNeverBeyondIt) {
  const auto robot = made();
  drive(*robot, 0.2, 5.0);
  EXPECT_LT(base.sent_v_mps, 0.3) << "0.5 m/s2";
  EXPECT_GT(base.sent_v_mps, 0.02);
  drive(*robot, 1.2, 5.0);
  EXPECT_DOUBLE_EQ(base.sent_v_mps, 0.4);
}

TEST_F(LiveRobots, StandWhenAnOrderIsTooOldHoweverLongItWasToCount) {
  const auto robot = made();
  drive(*robot, 0.3);
  EXPECT_TRUE(stands_within(0.5));
}

TEST_F(LiveRobots, SayZeroForHalfASecondThenOnlyThatTheMissionLives) {
  const auto robot = made();
  drive(*robot, 0.3);
  for (const double begin_s = now_s(); now_s() - begin_s < 1.2;) (void)robot->next({});
  const int sent = base.sent;
  EXPECT_GE(base.pulses, 1);
  for (const double begin_s = now_s(); now_s() - begin_s < 0.3;) (void)robot->next({});
  EXPECT_EQ(base.sent, sent);
}

TEST_F(LiveRobots, SayNothingWhileTheyAreSilentAndThenZero) {
  const auto robot = made();
  drive(*robot, 0.3);
  robot->be_silent(0.6);
  std::this_thread::sleep_for(std::chrono::milliseconds(60));  // what was on its way
  const int sent = base.sent;
  const int pulses = base.pulses;
  for (const double begin_s = now_s(); now_s() - begin_s < 0.4;) (void)robot->next({});
  EXPECT_EQ(base.sent, sent);
  EXPECT_EQ(base.pulses, pulses);
  EXPECT_GT(base.sent_v_mps, 0.0) << "nobody has told it to stand";
  for (const double begin_s = now_s(); base.sent == sent && now_s() - begin_s < 2.0;) (void)robot->next({});
  EXPECT_EQ(base.sent_v_mps, 0.0);
}

TEST_F(LiveRobots, AStopEndsTheSilence) {
  const auto robot = made();
  base.stops_by_the_sender = true;
  drive(*robot, 0.3);
  robot->be_silent(30.0);
  robot->stop();
  EXPECT_TRUE(stands_within(0.5));
}

TEST_F(LiveRobots, DoNotSayThatAMissionLivesThatAsksForNothing) {
  const auto robot = made();
  (void)robot->next({});
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  const int pulses = base.pulses;
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  EXPECT_EQ(base.pulses, pulses);
}

TEST_F(LiveRobots, StandAndConnectAgainWhenTheBaseSaysNothing) {
  const auto robot = made();
  drive(*robot, 0.3);
  base.is_silent = true;
  std::thread again([this] {
    EXPECT_TRUE(stands_within(0.7));
    while (base.connections < 2) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    base.is_silent = false;
  });
  EXPECT_EQ(robot->next({}).state, SensorState::observation);
  again.join();
}

TEST_F(LiveRobots, AStopThatALinkCannotSendByItselfIsSentByTheThreadThatSends) {
  const auto robot = made();
  drive(*robot, 0.3);
  robot->stop();
  EXPECT_TRUE(robot->is_stop_sent()) << "by the link";
  base.stops_by_the_sender = true;
  drive(*robot, 0.3);
  EXPECT_GT(base.sent_v_mps, 0.0);
  robot->stop();
  for (const double begin_s = now_s(); !robot->is_stop_sent() && now_s() - begin_s < 5.0;) std::this_thread::yield();
  EXPECT_TRUE(robot->is_stop_sent());
  EXPECT_EQ(base.sent_v_mps, 0.0);
}

TEST_F(LiveRobots, AStopWithoutAConnectionIsNotSent) {
  base.stops_by_the_sender = true;
  const auto robot = made();
  robot->stop();
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  EXPECT_FALSE(robot->is_stop_sent());
}

TEST_F(LiveRobots, WhatWasOrderedBeforeAGapDoesNotCount) {
  const auto robot = made();
  drive(*robot, 0.3);
  base.is_gone = true;
  robot->command({0.2, 0.0}, 1.0);
  (void)robot->next({});  // the last of the old connection
  (void)robot->next({});
  EXPECT_EQ(base.connections, 2);
  EXPECT_EQ(base.sent_v_mps, 0.0);
}

TEST_F(LiveRobots, EndAsAFaultWhenNobodyIsThere) {
  base.is_there = false;
  LiveRules rules;
  rules.reconnect_s = 0.1;
  const auto robot = made(rules);
  const SensorStep step = robot->next({});
  EXPECT_EQ(step.state, SensorState::fault);
  EXPECT_THAT(step.reason, HasSubstr("no observation from the fake for 0."));
  EXPECT_THAT(step.reason, HasSubstr(" s: it is off"));
}

TEST_F(LiveRobots, SayWithinASecondWhatTheyWaitForAndForHowLong) {
  base.is_there = false;
  LiveRules rules;
  rules.reconnect_s = 1.5;
  const auto robot = made(rules);
  EXPECT_EQ(robot->waits_for(), "");
  std::thread mission([&] { EXPECT_EQ(robot->next({}).state, SensorState::fault); });
  const double begin_s = now_s();
  while (robot->waits_for().empty() && now_s() - begin_s < 1.4)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_LT(now_s() - begin_s, 1.0);
  EXPECT_EQ(robot->waits_for(), "waiting for the fake, 1.5 s at most; it is off");
  mission.join();
}

TEST_F(LiveRobots, DoNotWaitOnceTheRobotIsThere) {
  const auto robot = made();
  drive(*robot, 0.9);
  EXPECT_EQ(robot->waits_for(), "");
}

TEST_F(LiveRobots, EndAsAFaultWithWhatTheBaseSaid) {
  base.is_mad = true;
  const auto robot = made();
  EXPECT_EQ(robot->next({}).reason, "the fake: speaks in tongues");
  EXPECT_GE(base.stops, 1);
  EXPECT_EQ(robot->next({}).reason, "the fake: speaks in tongues");
}

TEST_F(LiveRobots, StandWhenTheBaseSaysWhatMakesNoSense) {
  const auto robot = made();
  drive(*robot, 0.3);
  EXPECT_GT(base.sent_v_mps, 0.0);
  base.is_mad = true;
  EXPECT_EQ(robot->next({}).state, SensorState::fault);
  EXPECT_TRUE(stands_within(0.5));
}

TEST_F(LiveRobots, RefuseWhatIsNotFinite) {
  const auto robot = made();
  EXPECT_THROW(robot->command({std::numeric_limits<double>::quiet_NaN(), 0.0}, 1.0), std::invalid_argument);
  EXPECT_THROW(robot->command({}, std::numeric_limits<double>::infinity()), std::invalid_argument);
}

TEST_F(LiveRobots, ReturnWhenTheyAreCancelled) {
  base.is_silent = true;
  const auto robot = made();
  Budget budget;
  budget.deadline = Budget::Clock::now() + std::chrono::milliseconds(50);
  EXPECT_THAT(robot->next(budget).reason, HasSubstr("cancelled while waiting for the fake"));
}

TEST(VelocityOrders, CountForTheirTimeAndUntilTheyAreStopped) {
  VelocityOrders orders;
  EXPECT_EQ(orders.ordered(0.0).v_mps, 0.0);
  orders.order({0.2, 0.1}, 0.3, 10.0);
  EXPECT_EQ(orders.ordered(10.29).v_mps, 0.2);
  EXPECT_EQ(orders.ordered(10.3).v_mps, 0.0);
  orders.order({0.2, 0.1}, 0.3, 11.0);
  orders.stop();
  EXPECT_EQ(orders.ordered(11.1).w_radps, 0.0);
  orders.order({0.1, 0.0}, 0.3, 12.0);
  EXPECT_EQ(orders.ordered(12.1).v_mps, 0.1);
}

TEST(Approached, GrowsSlowlyAndFallsAtOnce) {
  const RobotModel robot;  // 0.4 m/s, 0.5 m/s2
  EXPECT_DOUBLE_EQ(approached({0.1, 0.0}, {0.4, 0.0}, 0.1, robot).v_mps, 0.15);
  EXPECT_DOUBLE_EQ(approached({0.3, 0.0}, {0.1, 0.0}, 0.1, robot).v_mps, 0.1);
  EXPECT_DOUBLE_EQ(approached({0.3, 0.0}, {0.0, 0.0}, 0.1, robot).v_mps, 0.0);
  EXPECT_DOUBLE_EQ(approached({0.3, 0.0}, {-0.3, 0.0}, 0.1, robot).v_mps, -0.05) << "by way of standing";
  EXPECT_DOUBLE_EQ(approached({0.4, 0.0}, {9.0, 0.0}, 0.1, robot).v_mps, 0.4);
}

}  // namespace
}  // namespace cairn::live
