// The sensor of docs/write-a-sensor.md does what that page says, with a pair of sockets in place of the board's line.

#include "tests/guide/wheels/board_robot.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <cstring>

namespace wheels {
namespace {

class BoardRobotTest : public testing::Test {
 protected:
  BoardRobotTest() {
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends_.data()), 0);
    robot_.sonars.resize(2);
    robot_.sonars[1].T_robot_sonar = {0.1, 0.0, 0.5};
    sensor_.emplace(ends_[0], Config{"the line", 0.05}, robot_);
  }
  ~BoardRobotTest() override {
    sensor_.reset();  // it stops the wheels: the line must be there
    ::close(ends_[1]);
  }

  void send(const Report& report, std::size_t from = 0, std::size_t to = sizeof(Report)) const {
    const auto* bytes = reinterpret_cast<const char*>(&report);
    ASSERT_EQ(::write(ends_[1], bytes + from, to - from), static_cast<ssize_t>(to - from));
  }

  std::array<int, 2> ends_{-1, -1};
  cairn::RobotModel robot_;
  std::optional<BoardRobot> sensor_;
};

TEST_F(BoardRobotTest, AReportOfTheBoardIsAnObservationWithThePlaceAndBeamOfItsSonar) {
  send({1.5, 0.2, 0.1, 0.3, 2.25, 1, 0});
  const cairn::SensorStep step = sensor_->next({});
  ASSERT_EQ(step.state, cairn::SensorState::observation) << step.reason;
  EXPECT_EQ(step.observation.stamp_s, 1.5);
  EXPECT_EQ(step.observation.T_odom_robot, (cairn::Pose2{0.2, 0.1, 0.3}));
  ASSERT_EQ(step.observation.ranges.size(), 1U);
  const cairn::RangeReading& reading = step.observation.ranges[0];
  EXPECT_EQ(reading.T_robot_sensor, robot_.sonars[1].T_robot_sonar);
  EXPECT_EQ(reading.max_m, robot_.sonars[1].max_m);
  EXPECT_EQ(reading.range_m, 2.25);
  EXPECT_EQ(reading.sensor, 1);
}

TEST_F(BoardRobotTest, NoEchoAndOneThatIsTooNearAreInfinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  send({1.0, 0, 0, 0, 0.0, 0, 0});
  send({1.1, 0, 0, 0, 0.01, 0, 1});
  EXPECT_EQ(sensor_->next({}).observation.ranges.at(0).range_m, kInfinity);
  const cairn::SensorStep near = sensor_->next({});
  EXPECT_EQ(near.observation.ranges.at(0).range_m, -kInfinity);
  EXPECT_TRUE(near.observation.bumped);
}

TEST_F(BoardRobotTest, AReportThatComesInPartsIsPutTogether) {
  const Report report{2.0, 0, 0, 0, 1.0, 0, 0};
  send(report, 0, 11);
  EXPECT_EQ(sensor_->next({}).state, cairn::SensorState::fault) << "the rest has not come";
  send(report, 11);
  EXPECT_EQ(sensor_->next({}).observation.stamp_s, 2.0);
}

TEST_F(BoardRobotTest, ASilentBoardIsAFaultWithItsReason) {
  const cairn::SensorStep step = sensor_->next({});
  EXPECT_EQ(step.state, cairn::SensorState::fault);
  EXPECT_EQ(step.reason, "the motor board on the line is silent");
}

TEST_F(BoardRobotTest, WhatNoBoardMayReportIsAFault) {
  send({1.0, 0, 0, 0, 1.0, 7, 0});
  EXPECT_EQ(sensor_->next({}).reason, "the motor board reports sonar 7, which the robot file has not");
  send({1.0, 0, 0, 0, 1.0, 0, 0});
  send({0.5, 0, 0, 0, 1.0, 0, 0});
  EXPECT_EQ(sensor_->next({}).state, cairn::SensorState::observation);
  EXPECT_EQ(sensor_->next({}).reason, "the motor board's clock went back");
}

TEST_F(BoardRobotTest, ItsDriveIsTheBoardsWheelsAndTheyStopWhenItIsGone) {
  sensor_->drive()->command({0.1, 0.0}, 0.5);
  Packet packet;
  ASSERT_EQ(::read(ends_[1], &packet, sizeof packet), static_cast<ssize_t>(sizeof packet));
  EXPECT_EQ(packet.v_mps, 0.1);
  sensor_.reset();
  ASSERT_EQ(::read(ends_[1], &packet, sizeof packet), static_cast<ssize_t>(sizeof packet));
  EXPECT_EQ(packet.v_mps, 0.0);
}

}  // namespace
}  // namespace wheels
