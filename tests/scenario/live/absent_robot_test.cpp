// A run whose robot is not there says what it waits for and for how long, and then why it ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenario/missions/doctor_mission.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Finished run_of(const std::string& name, const std::string& sensor) {
  const auto mission = doctor_mission(name, sensor + ", stop_when: {reconnect_s: 1.2}");
  return run_cairn({"run", mission.string(), "--out", (mission.parent_path() / "out").string()});
}

TEST(AbsentRobot, AtASerialLineIsNamedByItsDevice) {
  const Finished finished = run_of("absent_pioneer", "plugin: p2os_robot, device: /dev/no_such_line");
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.err,
              HasSubstr("waiting for the robot at /dev/no_such_line, 1.2 s at most; /dev/no_such_line: No "
                        "such file or directory: is the cable plugged in?"));
  EXPECT_THAT(finished.out, AllOf(HasSubstr("sensor_fault"),
                                  HasSubstr("no observation from the robot at /dev/no_such_line for 1.2 s")));
}

TEST(AbsentRobot, BehindRosbridgeIsNamedByTopicAndAddress) {
  const Finished finished =
      run_of("absent_bridge", "plugin: rosbridge_robot, host: 127.0.0.1, port: 1, ranges: [{topic: /sonar}]");
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.err, AllOf(HasSubstr("waiting for /odom of the robot at "), HasSubstr("127.0.0.1"),
                                  HasSubstr("1.2 s at most")));
}

#ifdef CAIRN_HAS_ROS2_ROBOT
TEST(AbsentRobot, OnARosNetworkIsNamedByTopicAndDomain) {
  const Finished finished =
      run_of("absent_ros2", "plugin: ros2_robot, domain: 149, network: localhost, ranges: [{topic: /sonar}]");
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.err, HasSubstr("waiting for /odom in ROS domain 149, 1.2 s at most"));
  EXPECT_THAT(finished.out, HasSubstr("nobody publishes anything in domain 149"));
}

std::string with_initial_pose(double wait_s) {
  return "plugin: ros2_robot, domain: 148, network: localhost, ranges: [{topic: /sonar}], initial_pose: {topic: "
         "/initialpose, wait_s: " +
         std::to_string(wait_s) + "}";
}

TEST(AbsentRobot, ItsFirstPoseIsNamedByTopicFrameAndDomain) {
  const Finished finished = run_of("absent_pose", with_initial_pose(1.0));
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err,
              AllOf(HasSubstr("waiting for a pose on /initialpose in the frame map of ROS domain 148, 1 s at "
                              "most"),
                    HasSubstr("nobody has given a pose on /initialpose in the frame map for 1 s")));
}

TEST(AbsentRobot, TheWaitForItsFirstPoseEndsWithCtrlC) {
  const auto mission = doctor_mission("absent_pose_cancelled", with_initial_pose(600.0));
  const Finished finished =
      interrupt_cairn({"run", mission.string(), "--out", (mission.parent_path() / "out").string()});
  EXPECT_EQ(finished.exit_status, 1) << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("cancelled by the user"));
}
#endif

}  // namespace
}  // namespace cairn::testing_program
