// `cairn doctor live` looks at a robot on a ROS 2 network, topic by topic.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "tests/plugins/ros2_robot/network_robot.hpp"
#include "tests/scenario/missions/doctor_mission.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Two tests at once must not meet.
int looked_at_domain() {
  return 150 + static_cast<int>(::getpid() % 40);
}

std::string sensor_of_network(const std::string& sonar) {
  return "plugin: ros2_robot, domain: " + std::to_string(looked_at_domain()) +
         ", network: localhost, ranges: [{topic: " + sonar + "}]";
}

TEST(DoctorRos2, SaysTypeQualityRateAgeFrameAndClockOfEachTopicAndWhoListens) {
  const ros2_robot::NetworkRobot robot(looked_at_domain());
  const ros2_robot::Entity listener = robot.participant().reader("/cmd_vel", geometry_msgs_msg_dds__Twist__desc);
  const auto mission = doctor_mission("doctor_ros2", sensor_of_network("/sonar"));
  const Finished finished = run_cairn({"doctor", "live", mission.string(), "--for", "1.5"});
  EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  EXPECT_THAT(
      finished.out,
      AllOf(HasSubstr("ok  connection       there\n"), HasSubstr(" published /odom, /sonar\n"),
            HasSubstr("ok  /odom            type nav_msgs/msg/Odometry; offered reliable, volatile; "
                      "wanted best_effort, volatile; rate "),
            HasSubstr("; frame odom; clock -0.0"), HasSubstr("ok  /sonar           type sensor_msgs/msg/Range; "),
            HasSubstr("ok  /cmd_vel         heard by 1 subscriber; type geometry_msgs/msg/Twist; ")));
  const Finished json = run_cairn({"doctor", "live", mission.string(), "--for", "1", "--json"});
  const auto said = nlohmann::json::parse(json.out);
  EXPECT_TRUE(said["ok"]);
  EXPECT_EQ(said["findings"][2]["what"], "/odom");
  EXPECT_EQ(said["findings"][2]["values"]["type"], "nav_msgs/msg/Odometry");
}

TEST(DoctorRos2, NamesWhatIsWrong) {
  const ros2_robot::NetworkRobot robot(looked_at_domain());
  const auto mission = doctor_mission("doctor_ros2_wrong", sensor_of_network("/sonars"));
  const Finished finished = run_cairn({"doctor", "live", mission.string(), "--for", "1", "--wiggle"});
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.out,
              AllOf(HasSubstr("BAD /sonars          nobody publishes it (did you mean \"/sonar\"?) (type "),
                    HasSubstr("BAD /cmd_vel         no base listens to it: the robot would not move (heard by nobody)"),
                    HasSubstr("no wheel was turned: mend what is BAD first")));
}

}  // namespace
}  // namespace cairn::testing_program
