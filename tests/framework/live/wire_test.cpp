#include "framework/live/wire.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cairn::live {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

RobotModel two_sonars() {
  RobotModel robot;
  robot.sonars = {{{0.1, 0.1, 1.5}, 0.26, 0.1, 5.0}, {{0.13, 0.0, 0.0}, 0.26, 0.1, 5.0}};
  return robot;
}

RangeReading reading_of(int sensor, double range_m) {
  const SonarModel model = two_sonars().sonars[static_cast<std::size_t>(sensor)];
  return {model.T_robot_sonar, model.half_beam_rad, model.min_m, model.max_m, range_m, sensor};
}

Observation observation_of(const std::string& line) {
  return base_line(line, two_sonars()).observation.value_or(Observation{});
}

std::string fault_in(const std::string& line) {
  try {
    (void)base_line(line, two_sonars());
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

TEST(Wire, OfALasersBeamOnlyTheNumberAndTheRangeAreSaid) {
  RobotModel robot = two_sonars();
  robot.lasers.emplace_back();
  robot.lasers[0].beams = 3;
  robot.lasers[0].T_robot_laser = {0.1, 0.0, 0.0};
  Observation seen;
  seen.ranges = {{robot.lasers[0].T_robot_beam(2), 0.0, robot.lasers[0].min_m, robot.lasers[0].max_m, 1.5, 4}};
  const std::string line = line_of(seen, robot);
  EXPECT_THAT(line, testing::HasSubstr("{\"sensor\":4,\"range_m\":1.5}"));
  const auto back = base_line(line, robot).observation;
  ASSERT_TRUE(back);
  EXPECT_EQ(back->ranges.at(0).T_robot_sensor, seen.ranges[0].T_robot_sensor);
  EXPECT_EQ(back->ranges[0].half_beam_rad, 0.0);
  EXPECT_EQ(back->ranges[0].max_m, robot.lasers[0].max_m);
}

TEST(Wire, AnObservationComesBackToTheLastBit) {
  Observation seen;
  seen.stamp_s = 0.1 + 0.2;
  seen.T_odom_robot = {1.0 / 3.0, -2e-17, 0.7};
  seen.compass_rad = -1.0 / 7.0;
  seen.bumped = true;
  seen.battery_ratio = 0.9;
  seen.stopped_by = "the red button";
  seen.ranges = {reading_of(0, 1.0 / 3.0), reading_of(1, kInf), reading_of(1, -kInf),
                 reading_of(0, std::numeric_limits<double>::quiet_NaN())};
  RangeReading laser = reading_of(0, 7.0);
  laser.sensor = 40;
  laser.max_m = 8.0;
  laser.T_robot_sensor.x_m = 0.2;
  seen.ranges.push_back(laser);
  const std::string line = line_of(seen, two_sonars());
  const Observation back = observation_of(line);
  EXPECT_EQ(line_of(back, two_sonars()), line);
  EXPECT_EQ(back.stamp_s, seen.stamp_s);
  EXPECT_EQ(back.T_odom_robot, seen.T_odom_robot);
  EXPECT_EQ(back.compass_rad, seen.compass_rad);
  EXPECT_TRUE(back.bumped);
  EXPECT_EQ(back.stopped_by, "the red button");
  EXPECT_EQ(back.battery_ratio, seen.battery_ratio);
  ASSERT_EQ(back.ranges.size(), 5U);
  for (std::size_t i : {0U, 1U, 2U, 4U}) {
    EXPECT_EQ(back.ranges[i].range_m, seen.ranges[i].range_m);
    EXPECT_EQ(back.ranges[i].T_robot_sensor, seen.ranges[i].T_robot_sensor);
    EXPECT_EQ(back.ranges[i].max_m, seen.ranges[i].max_m);
  }
  EXPECT_TRUE(std::isnan(back.ranges[3].range_m));
}

TEST(Wire, WhatTheRobotsFileSaysNeedNotBeSaid) {
  const Observation seen = observation_of(
      R"({"stamp_s": 2, "odometry": {"x_m": 1, "y_m": 0, "theta_rad": 0}, "ranges": [{"sensor": 1, "range_m": 2.5},
          {"sensor": 0, "range_m": 9}, {"sensor": 0, "range_m": 0.01}], "colour": "red"})");
  ASSERT_EQ(seen.ranges.size(), 3U);
  EXPECT_EQ(seen.ranges[0].T_robot_sensor, (Pose2{0.13, 0.0, 0.0}));
  EXPECT_EQ(seen.ranges[0].range_m, 2.5);
  EXPECT_EQ(seen.ranges[1].range_m, kInf) << "beyond the transducer's reach";
  EXPECT_EQ(seen.ranges[2].range_m, -kInf);
  EXPECT_FALSE(seen.compass_rad);
}

TEST(Wire, ABadLineSaysWhatIsWrongWithIt) {
  const std::string begin = R"({"stamp_s": 2, "odometry": {"x_m": 1, "y_m": 0, "theta_rad": 0}, )";
  EXPECT_EQ(fault_in("hello"), "not JSON");
  EXPECT_EQ(fault_in("[1]"), "not a JSON object");
  EXPECT_EQ(fault_in(std::string(100000, '[')), "not JSON");
  EXPECT_EQ(fault_in(R"({"stamp_s": "noon"})"), "\"stamp_s\" must be a number");
  EXPECT_EQ(fault_in(R"({"stamp_s": 1e999})"), "not JSON");
  EXPECT_EQ(fault_in(R"({"stamp_s": 1})"), "no \"odometry\"");
  EXPECT_EQ(fault_in(begin + R"("ranges": 3})"), "\"ranges\" must be a list");
  EXPECT_EQ(fault_in(begin + R"("ranges": [3]})"), "each of \"ranges\" must be an object");
  EXPECT_EQ(fault_in(begin + R"("ranges": [{"sensor": 0}]})"), "no \"range_m\"");
  EXPECT_EQ(fault_in(begin + R"("ranges": [{"sensor": 0.5, "range_m": 1}]})"),
            "\"sensor\" must be a transducer's number, from 0 on");
  EXPECT_EQ(fault_in(begin + R"("ranges": [{"sensor": 7, "range_m": 1}]})"), "no \"x_m\"")
      << "the robot's file has no seventh";
  EXPECT_EQ(fault_in(begin + R"("ranges": [{"sensor": 0, "range_m": "far"}]})"),
            "\"range_m\" must be a number, no_echo, too_near or bad");
}

TEST(Wire, ABaseSaysInItsOwnWordsWhatIsWrong) {
  EXPECT_EQ(base_line(fault_line("the \"wheels\" are off"), two_sonars()).fault, "the \"wheels\" are off");
  const BaseLine unknown = base_line(R"({"hello": 1})", two_sonars());
  EXPECT_FALSE(unknown.observation);
  EXPECT_EQ(unknown.fault, "");
}

TEST(Wire, ACommandComesBackToTheLastBit) {
  const CommandLine line({1.0 / 3.0, -0.1}, 0.5);
  const ClientLine back = client_line(line.text().substr(0, line.text().size() - 1));
  EXPECT_EQ(back.kind, ClientLine::Kind::command);
  EXPECT_EQ(back.twist, (Twist{1.0 / 3.0, -0.1}));
  EXPECT_EQ(back.valid_for_s, 0.5);
  EXPECT_EQ(client_line(kStopLine).kind, ClientLine::Kind::stop);
  EXPECT_EQ(client_line(kNextLine).kind, ClientLine::Kind::next);
  EXPECT_EQ(client_line(R"({"sing": true})").kind, ClientLine::Kind::unknown);
  EXPECT_THROW((void)client_line(R"({"v_mps": 0.1, "w_radps": 0})"), std::runtime_error) << "for how long?";
}

}  // namespace
}  // namespace cairn::live
