#include "plugins/common/ros/robot_observer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cairn::ros {
namespace {

using testing::HasSubstr;

RobotModel robot_with_two_sonars() {
  RobotModel robot;
  robot.sonars.resize(2);
  return robot;
}

RobotTopics topics_of_two_sonars() {
  RobotTopics topics;
  topics.ranges = {{"/sonar", RangeKind::range, {"left", "right"}, 0}, {"/ring", RangeKind::point_cloud, {}, 0}};
  topics.compass.topic = "/imu";
  topics.battery = "/battery";
  topics.bumpers = {"/front", "/rear"};
  topics.emergency = "/e_stop";
  return topics;
}

struct Watched {
  RobotModel robot = robot_with_two_sonars();
  RobotTopics topics = topics_of_two_sonars();
  RobotObserver observer{topics, robot};

  [[nodiscard]] std::optional<Observation> odometry(double stamp_s, double x_m = 0.0) {
    return observer.take(Odometry{{stamp_s, "odom"}, "base_link", {x_m, 0.0}, {0.0, 0.0, 0.0, 1.0}}, stamp_s);
  }
  void range(double stamp_s, const std::string& frame, double range_m) {
    observer.take(topics.ranges[0], Range{{stamp_s, frame}, 0.1, 5.0, range_m}, stamp_s);
  }
};

TEST(RobotObserver, AReadingIsSeenFromWhereTheRobotIsNow) {
  Watched watched;
  (void)watched.odometry(10.0, 0.0);
  watched.range(10.1, "right", 2.0);
  const auto seen = watched.odometry(10.2, 0.2);
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->ranges.size(), 1U);
  EXPECT_EQ(seen->ranges[0].sensor, 1);
  EXPECT_NEAR(seen->ranges[0].T_robot_sensor.x_m, -0.1, 1e-9) << "half of the way, which is 0.2 m";
  EXPECT_TRUE(watched.odometry(10.3)->ranges.empty()) << "once";
}

TEST(RobotObserver, WhatIsSaidBesidesGoesWithTheNextOdometry) {
  Watched watched;
  watched.observer.take_compass({}, 0.5, 1.0);
  watched.observer.take_battery({}, 80.0, 1.0);
  watched.observer.take_bumper(1, true, 1.0);
  const auto seen = watched.odometry(1.0);
  EXPECT_EQ(seen->compass_rad, 0.5);
  EXPECT_EQ(seen->battery_ratio, 0.8);
  EXPECT_TRUE(seen->bumped);
  const auto next = watched.odometry(1.1);
  EXPECT_FALSE(next->compass_rad) << "once";
  EXPECT_EQ(next->battery_ratio, 0.8) << "as long as nothing else is said";
  EXPECT_TRUE(next->bumped) << "the same";
  watched.observer.take_bumper(0, false, 1.1);
  EXPECT_TRUE(watched.odometry(1.2)->bumped) << "the other one is free";
  watched.observer.take_bumper(1, false, 1.2);
  EXPECT_FALSE(watched.odometry(1.3)->bumped);
}

TEST(RobotObserver, AnEmergencyLastsUntilItIsOver) {
  Watched watched;
  EXPECT_FALSE(watched.observer.is_emergency());
  watched.observer.take_emergency(true, 1.0);
  EXPECT_TRUE(watched.observer.is_emergency());
  EXPECT_EQ(watched.odometry(1.5)->stopped_by, "the emergency topic /e_stop");
  watched.observer.take_emergency(false, 2.0);
  EXPECT_FALSE(watched.observer.is_emergency());
  EXPECT_EQ(watched.odometry(2.5)->stopped_by, "");
}

TEST(RobotObserver, OdometryThatIsNoPoseIsHeardAndLeftOut) {
  Watched watched;
  EXPECT_FALSE(watched.odometry(1.0, std::nan("")));
  EXPECT_EQ(watched.observer.heard().find("/odom")->messages, 1U);
}

TEST(RobotObserver, OdometryThatComesAfterALaterOneIsLeftOut) {
  Watched watched;
  const double first_s = watched.odometry(10.0, 0.0)->stamp_s;
  EXPECT_TRUE(watched.odometry(10.1, 0.1));
  EXPECT_FALSE(watched.odometry(10.05, 0.05));
  EXPECT_EQ(watched.odometry(10.1, 0.1)->stamp_s, watched.odometry(10.1, 0.1)->stamp_s) << "twice the same";
  const auto next = watched.odometry(10.2, 0.2);
  EXPECT_NEAR(next->stamp_s - first_s, 0.2, 1e-9);
  EXPECT_NEAR(next->T_odom_robot.x_m, 0.2, 1e-9);
  EXPECT_TRUE(watched.odometry(3.0, 0.3)) << "the clock was set";
}

TEST(RobotObserver, AFrameThatTheSettingsDoNotNameIsAFault) {
  Watched watched;
  try {
    watched.range(1.0, "lefd", 1.0);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("/sonar has the frame \"lefd\", and `frames` does not (did you mean \"left\"?)"));
  }
}

TEST(RobotObserver, ReadingsOfBeforeAGapAreForgotten) {
  Watched watched;
  (void)watched.odometry(1.0);
  watched.range(1.1, "left", 1.0);
  watched.observer.forget_readings();
  EXPECT_TRUE(watched.odometry(1.2)->ranges.empty());
}

TEST(RobotObserver, ByArrivalTheStampsOfMessagesDoNotCount) {
  Watched watched;
  watched.topics.stamp = Stamp::arrival;
  (void)watched.observer.take(Odometry{{1000.0, "odom"}, "base_link", {0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}, 5.0);
  watched.observer.take(watched.topics.ranges[0], Range{{3.0, "left"}, 0.1, 5.0, 1.0}, 5.1);
  const auto seen = watched.observer.take(Odometry{{7.0, "odom"}, "base_link", {0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}, 5.2);
  EXPECT_NEAR(seen->stamp_s, 5.2, 1e-9);
  EXPECT_EQ(seen->ranges.size(), 1U);
}

}  // namespace
}  // namespace cairn::ros
