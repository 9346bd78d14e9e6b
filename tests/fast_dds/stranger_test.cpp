// Cairn drives a robot whose messages are written and read by Fast DDS, with all qualities of service that ROS uses.
#include "tests/fast_dds/stranger.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>
#include <thread>

#include "framework/live/live_robot.hpp"
#include "plugins/ros2_robot/ros2_robot.hpp"
#include "tests/fast_dds/messages_by_hand.hpp"

namespace cairn::fast_dds {
namespace {

using ros2_robot::Config;
using ros2_robot::RangeKind;

constexpr const char* kOdometry = "nav_msgs::msg::dds_::Odometry_";
constexpr const char* kTwist = "geometry_msgs::msg::dds_::Twist_";
constexpr const char* kTwistStamped = "geometry_msgs::msg::dds_::TwistStamped_";

RobotModel robot_with_sonar_and_laser() {
  RobotModel model;
  model.sonars.resize(1);
  model.lasers.resize(1);
  return model;
}

Config config_of_stranger() {
  Config made;
  made.domain = own_domain();
  made.network = ros2_robot::Network::localhost;
  made.ranges = {{"/sonar", RangeKind::range, {}, 0}, {"/scan", RangeKind::laser, {}, 0}};
  made.compass.topic = "/imu";
  made.battery = "/battery";
  made.bumpers = {"/bumper"};
  return made;
}

constexpr double kStep_m = 0.004;

// Publishes fifty times a second what a robot sees that drives straight on.
class StrangeRobot {
 public:
  explicit StrangeRobot(Offer offer)
      : odometry_(stranger_.writer("/odom", kOdometry, offer)),
        sonar_(stranger_.writer("/sonar", "sensor_msgs::msg::dds_::Range_", offer)),
        scan_(stranger_.writer("/scan", "sensor_msgs::msg::dds_::LaserScan_", offer)),
        imu_(stranger_.writer("/imu", "sensor_msgs::msg::dds_::Imu_", offer)),
        battery_(stranger_.writer("/battery", "sensor_msgs::msg::dds_::BatteryState_", offer)),
        bumper_(stranger_.writer("/bumper", "std_msgs::msg::dds_::Bool_", offer)),
        thread_([this](const std::stop_token& ended) {
          for (std::int32_t tick = 0; !ended.stop_requested(); ++tick) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            publish(tick);
          }
        }) {}
  Stranger& stranger() { return stranger_; }

 private:
  void publish(std::int32_t tick) {
    const auto nanosec = static_cast<std::uint32_t>(tick % 50) * 20'000'000U;
    const Stamped header{1000 + tick / 50, nanosec, "odom"};
    const Stamped sensor{header.sec, header.nanosec, "base_link"};
    sonar_->write(written([&](Cdr& to) { write_range(to, sensor, 2.5F); }));
    scan_->write(written([&](Cdr& to) { write_scan(to, sensor, {1.0F, 2.0F, 3.0F}); }));
    imu_->write(written([&](Cdr& to) { write_imu(to, sensor, {0.0, 0.0, 1.0, 0.0}); }));
    battery_->write(written([&](Cdr& to) { write_battery(to, sensor, 0.75F); }));
    bumper_->write(written([&](Cdr& to) { write_bool(to, true); }));
    odometry_->write(written([&](Cdr& to) {
      write_odometry(to, header, "base_link", {4.0 + kStep_m * tick, -2.0, 0.0, 0.0, 0.0, 0.0, 1.0});
    }));
  }

  Stranger stranger_{own_domain()};
  std::unique_ptr<Stranger::Writer> odometry_;
  std::unique_ptr<Stranger::Writer> sonar_;
  std::unique_ptr<Stranger::Writer> scan_;
  std::unique_ptr<Stranger::Writer> imu_;
  std::unique_ptr<Stranger::Writer> battery_;
  std::unique_ptr<Stranger::Writer> bumper_;
  std::jthread thread_;
};

bool is_complete(const Observation& seen) {
  return seen.T_odom_robot.x_m > 0.0 && seen.ranges.size() >= 4 && seen.compass_rad && seen.battery_ratio &&
         seen.bumped;
}

void expect_what_was_written(const Observation& seen) {
  const double steps = seen.T_odom_robot.x_m / kStep_m;  // since it was seen first
  EXPECT_NEAR(steps, std::round(steps), 1e-6);
  EXPECT_EQ(seen.T_odom_robot.y_m, 0.0);
  EXPECT_NEAR(std::abs(seen.compass_rad.value_or(0.0)), std::numbers::pi, 1e-9);
  EXPECT_FLOAT_EQ(static_cast<float>(seen.battery_ratio.value_or(0.0)), 0.75F);
  std::vector<double> ranges;
  for (const RangeReading& reading : seen.ranges) ranges.push_back(reading.range_m);
  EXPECT_THAT(ranges, testing::IsSupersetOf({2.5, 1.0, 2.0, 3.0}));
}

// A robot may bind to the loopback then, or not; this one does.
TEST(LocalhostOfTheEnvironment, MeetsARobotThatIsBoundToTheLoopback) {
  ::setenv("ROS_LOCALHOST_ONLY", "1", 1);
  const StrangeRobot robot(Offer{});
  Config config = config_of_stranger();
  config.network = ros2_robot::Network::environment;
  {
    live::LiveRobot driven(ros2_robot::link_to(config, robot_with_sonar_and_laser()), config.stop_when,
                           robot_with_sonar_and_laser());
    const SensorStep step = driven.next({});
    EXPECT_EQ(step.state, SensorState::observation) << step.reason;
  }
  ::unsetenv("ROS_LOCALHOST_ONLY");
}

class Quality : public testing::TestWithParam<std::pair<bool, bool>> {
 protected:
  const Offer offer_{GetParam().first, GetParam().second};
};

TEST_P(Quality, WhateverTheRobotOffersIsRead) {
  const StrangeRobot robot(offer_);
  const Config config = config_of_stranger();
  live::LiveRobot driven(link_to(config, robot_with_sonar_and_laser()), config.stop_when, robot_with_sonar_and_laser());
  Observation seen;
  ASSERT_TRUE(comes_true([&] {
    SensorStep step = driven.next({});
    seen = std::move(step.observation);
    return step.state == SensorState::observation && is_complete(seen);
  }));
  expect_what_was_written(seen);
}

INSTANTIATE_TEST_SUITE_P(Offers, Quality,
                         testing::Values(std::pair(true, false), std::pair(false, false), std::pair(true, true),
                                         std::pair(false, true)));

// Drives until the velocity has come, or ten seconds are over.
Bytes velocity_of(live::LiveRobot& driven, Stranger::Reader& reader, double v_mps) {
  Bytes last;
  (void)comes_true([&] {
    EXPECT_EQ(driven.next({}).state, SensorState::observation);
    driven.drive()->command({v_mps, 0.125}, 0.3);
    for (Bytes& message : reader.take()) last = std::move(message);
    if (last.empty()) return false;
    const TwistNumbers twist = [&] {
      TwistNumbers numbers{};
      const std::size_t at = last.size() - sizeof numbers;
      std::copy(last.begin() + static_cast<std::ptrdiff_t>(at), last.end(), reinterpret_cast<char*>(numbers.data()));
      return numbers;
    }();
    return twist[0] == v_mps;
  });
  return last;
}

class Wish : public testing::TestWithParam<std::pair<bool, bool>> {};

// reliable or not, stamped or not.
TEST_P(Wish, WhateverTheRobotWantsIsWritten) {
  const bool is_reliable = GetParam().first;
  const bool is_stamped = GetParam().second;
  StrangeRobot robot(Offer{});
  const auto reader = robot.stranger().reader("/cmd_vel", is_stamped ? kTwistStamped : kTwist, Offer{is_reliable});
  const Config config = config_of_stranger();
  live::LiveRobot driven(link_to(config, robot_with_sonar_and_laser()), config.stop_when, robot_with_sonar_and_laser());
  const Bytes last = velocity_of(driven, *reader, 0.25);
  ASSERT_FALSE(last.empty());
  TwistNumbers twist{};
  Stamped header;
  const std::size_t left = read_all(last, [&](Cdr& from) {
    if (is_stamped) header = read_header(from);
    from >> twist;
  });
  EXPECT_EQ(left, 0U);
  EXPECT_THAT(twist, testing::ElementsAre(0.25, 0.0, 0.0, 0.0, 0.0, 0.125));
  if (is_stamped) {
    EXPECT_EQ(header.frame, "base_link");
    EXPECT_NEAR(header.sec, 1000, 60) << "the base's own clock";
  }
}

INSTANTIATE_TEST_SUITE_P(Wishes, Wish,
                         testing::Values(std::pair(true, false), std::pair(false, false), std::pair(true, true),
                                         std::pair(false, true)));

// Said once, before Cairn was there.
TEST(LateJoiner, GetsTheStaticFramesThatWereWrittenBefore) {
  StrangeRobot robot(Offer{});
  const auto frames = robot.stranger().writer("/tf_static", "tf2_msgs::msg::dds_::TFMessage_", Offer{true, true});
  frames->write(written([](Cdr& to) {
    write_transforms(to, {{{0, 0, "base_footprint"}, "base_link", {0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}}});
  }));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  Config config = config_of_stranger();
  config.mounting = ros2_robot::Mounting::frames;
  config.base_frame = "base_footprint";
  live::LiveRobot driven(link_to(config, robot_with_sonar_and_laser()), config.stop_when, robot_with_sonar_and_laser());
  EXPECT_TRUE(comes_true([&] {
    const SensorStep step = driven.next({});
    EXPECT_EQ(step.state, SensorState::observation) << step.reason;
    return !step.observation.ranges.empty() && step.observation.ranges[0].T_robot_sensor.x_m == 0.25;
  }));
}

}  // namespace
}  // namespace cairn::fast_dds
