// A robot of a ROS 2 network, and what becomes of its wheels. The robot here is another participant of the same domain,
// on this computer only.
#include "plugins/ros2_robot/ros2_robot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "framework/live/live_robot.hpp"
#include "framework/live/steady_time.hpp"
#include "plugins/ros2_robot/dds/endpoints.hpp"
#include "plugins/ros2_robot/messages.hpp"
#include "tests/plugins/common/time_to_stand.hpp"

namespace cairn::ros2_robot {
namespace {

using testing::HasSubstr;

// Two tests at once must not meet.
int own_domain() {
  return 100 + static_cast<int>(::getpid() % 100);
}

class RosBase {
 public:
  explicit RosBase(bool wants_stamped = false)
      : participant_({own_domain(), true, "", {}}),
        odometry_(participant_.writer("/odom", nav_msgs_msg_dds__Odometry__desc)),
        sonar_(participant_.writer("/sonar", sensor_msgs_msg_dds__Range__desc)),
        emergency_(participant_.writer("/e_stop", std_msgs_msg_dds__Bool__desc)),
        commands_(participant_.reader("/cmd_vel", wants_stamped ? geometry_msgs_msg_dds__TwistStamped__desc
                                                                : geometry_msgs_msg_dds__Twist__desc)),
        wants_stamped_(wants_stamped),
        thread_([this](const std::stop_token& ended) { run(ended); }) {}
  ~RosBase() {
    thread_.request_stop();
    thread_.join();
  }
  std::atomic<bool> is_silent{false};
  std::atomic<double> v_mps{0.0};
  std::atomic<int> heard{0};
  std::atomic<double> offset_s{0.0};       // of its clock
  std::atomic<bool> is_doubling{false};    // each odometry comes twice
  std::atomic<bool> is_reordering{false};  // and the one before comes once more

  void set_emergency(bool is_on) const {
    const Bool message{is_on};
    (void)dds_write(emergency_.get(), &message);
  }
  [[nodiscard]] bool stands_within(double within_s) const { return wait_for_wheels(false, within_s); }
  [[nodiscard]] bool drives_within(double within_s) const { return wait_for_wheels(true, within_s); }

 private:
  [[nodiscard]] bool wait_for_wheels(bool turning, double within_s) const {
    for (const double begin_s = live::now_s(); live::now_s() - begin_s < within_s;) {
      if ((v_mps != 0.0) == turning) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }
  void run(const std::stop_token& ended) {
    int tick = 0;
    struct {
      decltype(Range::header.stamp) stamp;
      double x_m;
    } before{time_of(1000.0), 0.0};
    while (!ended.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      const auto take = [this](const TwistMessage& twist) {
        v_mps = twist.linear.x;
        ++heard;
      };
      if (wants_stamped_)
        take_all<TwistStamped>(commands_.get(), [&](const TwistStamped& stamped) { take(stamped.twist); });
      else
        take_all<TwistMessage>(commands_.get(), take);
      x_m_ += 0.02 * v_mps;
      if (is_silent) continue;
      char frame[] = "sonar_1";
      Range range{};
      range.header = {time_of(1000.0 + offset_s + 0.02 * tick), frame};
      range.min_range = 0.1F;
      range.max_range = 5.0F;
      range.range = 2.0F;
      (void)dds_write(sonar_.get(), &range);
      char base[] = "base_link";
      Odometry odometry{};
      odometry.header = range.header;
      odometry.child_frame_id = base;
      odometry.pose.pose.position.x = x_m_;
      odometry.pose.pose.orientation.w = 1.0;
      (void)dds_write(odometry_.get(), &odometry);
      if (is_doubling) (void)dds_write(odometry_.get(), &odometry);
      if (is_reordering) {
        odometry.header.stamp = before.stamp;
        odometry.pose.pose.position.x = before.x_m;
        (void)dds_write(odometry_.get(), &odometry);
      }
      before = {range.header.stamp, x_m_};
      ++tick;
    }
  }

  Participant participant_;
  Entity odometry_;
  Entity sonar_;
  Entity emergency_;
  Entity commands_;
  bool wants_stamped_;
  double x_m_ = 0.0;
  std::jthread thread_;
};

RobotModel robot() {
  RobotModel model;
  model.sonars.resize(3);
  return model;
}

Config config() {
  Config made;
  made.domain = own_domain();
  made.network = Network::localhost;
  made.ranges = {{"/sonar", RangeKind::range, {"sonar_0", "sonar_1", "sonar_2"}, 0}};
  made.emergency = "/e_stop";
  return made;
}

std::unique_ptr<live::LiveRobot> connected(const Config& made = config()) {
  return std::make_unique<live::LiveRobot>(link_to(made, robot()), made.stop_when, robot());
}

auto stands(const RosBase& base) {
  return [&base](double within_s) { return base.stands_within(within_s); };
}

void drive(live::LiveRobot& driven, double for_s) {
  for (const double begin_s = live::now_s(); live::now_s() - begin_s < for_s;) {
    const SensorStep step = driven.next({});
    ASSERT_EQ(step.state, SensorState::observation) << step.reason;
    driven.drive()->command({0.2, 0.0}, 0.3);
  }
}

TEST(Ros2Robot, DrivesWithEitherKindOfVelocity) {
  for (const bool stamped : {false, true}) {
    const RosBase base(stamped);
    const auto driven = connected();
    drive(*driven, 1.5);
    EXPECT_NEAR(base.v_mps, 0.2, 1e-9) << stamped;
    const SensorStep step = driven->next({});
    EXPECT_GT(step.observation.T_odom_robot.x_m, 0.05);
    ASSERT_FALSE(step.observation.ranges.empty());
    EXPECT_EQ(step.observation.ranges[0].sensor, 1);
    EXPECT_EQ(step.observation.ranges[0].range_m, 2.0);
  }
}

TEST(Ros2Robot, StandsWhenNobodyOrdersOrTheBaseIsSilentOrInAnEmergency) {
  RosBase base;
  const auto driven = connected();
  drive(*driven, 1.0);
  ASSERT_GT(base.v_mps, 0.0);
  const TimeToStand no_order("no order any more");
  EXPECT_TRUE(no_order.is_short(stands(base)));
  drive(*driven, 0.5);
  ASSERT_GT(base.v_mps, 0.0);
  base.set_emergency(true);
  drive(*driven, 0.3);
  EXPECT_EQ(base.v_mps, 0.0) << "emergency";
  base.set_emergency(false);
  drive(*driven, 0.5);
  ASSERT_GT(base.v_mps, 0.0);
  base.is_silent = true;
  std::thread again([&base] {
    const TimeToStand silence("the base says nothing");
    EXPECT_TRUE(silence.is_short(stands(base)));
    base.is_silent = false;
  });
  EXPECT_EQ(driven->next({}).state, SensorState::observation);
  again.join();
}

TEST(Ros2Robot, StandsWhenItIsDestroyed) {
  const RosBase base;
  auto driven = connected();
  drive(*driven, 1.0);
  ASSERT_GT(base.v_mps, 0.0);
  const TimeToStand time("the module is unloaded");
  driven.reset();
  EXPECT_TRUE(time.is_short(stands(base)));
}

// Of a robot without a time-out of its own.
TEST(Ros2Robot, StandsWhenItsProcessIsKilledOrHaltedAndGoesOnAfterwards) {
  for (const bool stamped : {false, true}) {
    const RosBase base(stamped);
    for (const int signal : {SIGKILL, SIGSTOP}) {
      const std::string domain = std::to_string(own_domain());
      const pid_t process = ::fork();
      if (process == 0) {
        ::execl(CAIRN_ROS2_DRIVER, CAIRN_ROS2_DRIVER, domain.c_str(), CAIRN_ROS2_GUARD, nullptr);
        ::_exit(127);
      }
      ASSERT_TRUE(base.drives_within(20.0)) << signal;
      std::this_thread::sleep_for(std::chrono::seconds(1));
      const TimeToStand time(signal == SIGKILL ? "SIGKILL" : "SIGSTOP");
      ::kill(process, signal);
      EXPECT_TRUE(time.is_short(stands(base)));
      ::kill(process, SIGCONT);
      if (signal == SIGSTOP) {
        EXPECT_TRUE(base.drives_within(1.0));
      }
      ::kill(process, SIGKILL);
      ::waitpid(process, nullptr, 0);
      EXPECT_TRUE(base.stands_within(0.5)) << signal;
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      EXPECT_EQ(base.v_mps, 0.0) << signal;
    }
  }
}

TEST(Ros2Robot, WithoutItsGuardItDoesNotDrive) {
  const RosBase base;
  live::LiveRobot driven(link_to(config(), robot(), {}, "/nowhere/ros2_guard"), config().stop_when, robot());
  const SensorStep step = driven.next({});
  EXPECT_EQ(step.state, SensorState::fault);
  EXPECT_THAT(step.reason, HasSubstr("/nowhere/ros2_guard, which guards the wheels, is no program"));
}

TEST(Ros2Robot, OdometryThatComesTwiceOrInAnotherOrderChangesNothing) {
  for (const bool is_reordering : {false, true}) {
    RosBase base;
    (is_reordering ? base.is_reordering : base.is_doubling) = true;
    const auto driven = connected();
    Observation last = driven->next({}).observation;
    for (const double begin_s = live::now_s(); live::now_s() - begin_s < 1.5;) {
      const SensorStep step = driven->next({});
      ASSERT_EQ(step.state, SensorState::observation) << step.reason;
      EXPECT_GE(step.observation.stamp_s, last.stamp_s);
      EXPECT_GE(step.observation.T_odom_robot.x_m, last.T_odom_robot.x_m - 1e-9);
      last = step.observation;
      driven->drive()->command({0.2, 0.0}, 0.3);
    }
    EXPECT_NEAR(base.v_mps, 0.2, 1e-9);
    const TimeToStand time(is_reordering ? "no order any more, odometry in another order"
                                         : "no order any more, odometry comes twice");
    EXPECT_TRUE(time.is_short(stands(base)));
  }
}

TEST(Ros2Robot, GoesOnWhenTheBasesClockIsSet) {
  RosBase base;
  const auto driven = connected();
  drive(*driven, 0.5);
  const double before_s = driven->next({}).observation.stamp_s;
  base.offset_s = -500.0;
  drive(*driven, 0.5);
  const double after_s = driven->next({}).observation.stamp_s;
  EXPECT_NEAR(after_s - before_s, 0.5, 0.3);
}

TEST(Ros2Robot, SaysWhoIsThereWhenItsTopicIsNot) {
  const RosBase base;
  Config other = config();
  other.odometry = "/odon";
  other.stop_when.reconnect_s = 1.0;
  EXPECT_THAT(connected(other)->next({}).reason,
              HasSubstr("nobody publishes /odon (did you mean \"/odom\"?); there are /e_stop, /odom, /sonar"));
}

TEST(Ros2Robot, SaysWhichRangesNobodyPublishes) {
  const RosBase base;
  Config other = config();
  other.stop_when.reconnect_s = 2.0;
  other.ranges[0].topic = "/robot1/sonar";
  const auto driven = connected(other);
  SensorStep step;
  for (const double begin_s = live::now_s(); live::now_s() - begin_s < 20.0 && step.state != SensorState::fault;)
    step = driven->next({});
  EXPECT_THAT(step.reason, HasSubstr("nobody publishes /robot1/sonar"));
}

TEST(Ros2Robot, SaysThatNobodyIsThere) {
  Config lonely = config();
  lonely.stop_when.reconnect_s = 0.2;
  EXPECT_THAT(connected(lonely)->next({}).reason, HasSubstr("nobody publishes anything in domain"));
}

TEST(Ros2Robot, AFrameThatTheSettingsDoNotNameIsAFault) {
  const RosBase base;
  Config other = config();
  other.ranges[0].frames = {"sonar_0"};
  EXPECT_THAT(connected(other)->next({}).reason,
              HasSubstr("/sonar has the frame \"sonar_1\", and `frames` does not (did you mean \"sonar_0\"?)"));
}

TEST(Ros2Robot, SettingsThatCannotBeAreRefused) {
  const auto refusal = [](auto change) -> std::string {
    Config made = config();
    change(made);
    try {
      (void)link_to(made, robot());
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal([](Config& c) { c.odometry = "odom"; }),
              HasSubstr("`odometry` is \"odom\"; a topic is given by"));
  EXPECT_THAT(refusal([](Config& c) { c.ranges.clear(); }), HasSubstr("`ranges` names no topic"));
  EXPECT_THAT(refusal([](Config& c) { c.ranges[0].first = 2; }),
              HasSubstr("/sonar is of sonar 4, and the robot's file has 3"));
}

}  // namespace
}  // namespace cairn::ros2_robot
