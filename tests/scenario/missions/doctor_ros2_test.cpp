// `cairn doctor live` looks at a robot on a ROS 2 network, topic by topic.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
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

// A variable of the environment of the programs that are started.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) { ::setenv(name, value.c_str(), 1); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { ::unsetenv(name_); }

 private:
  const char* name_;
};

TEST(DoctorRos2, SaysWhatTheEnvironmentSaid) {
  const ros2_robot::NetworkRobot robot(looked_at_domain());
  const ros2_robot::Entity listener = robot.participant().reader("/cmd_vel", geometry_msgs_msg_dds__Twist__desc);
  const Variable domain("ROS_DOMAIN_ID", std::to_string(looked_at_domain()));
  const Variable local("ROS_LOCALHOST_ONLY", "1");
  const auto mission = doctor_mission("doctor_ros2_environment", "plugin: ros2_robot, ranges: [{topic: /sonar}]");
  const Finished finished = run_cairn({"doctor", "live", mission.string(), "--for", "1.5"});
  EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("published /odom, /sonar; environment ROS_DOMAIN_ID=" +
                                      std::to_string(looked_at_domain()) + ", ROS_LOCALHOST_ONLY=1\n"));
}

TEST(DoctorRos2, AVariableThatCannotBeIsAnErrorThatNamesIt) {
  const Variable domain("ROS_DOMAIN_ID", "300");
  const auto open = doctor_mission("doctor_ros2_variable", "plugin: ros2_robot, ranges: [{topic: /sonar}]");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"doctor", "live", open.string()},
        {"run", open.string(), "--out", (open.parent_path() / "out").string()}}) {
    const Finished finished = run_cairn(command);
    EXPECT_EQ(finished.exit_status, 2) << finished.out;
    EXPECT_THAT(finished.err, HasSubstr("the environment variable ROS_DOMAIN_ID is \"300\": a domain is a number"));
  }
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
