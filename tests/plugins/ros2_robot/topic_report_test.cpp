// What is said of the topics that a robot is connected by, with all that can be wrong with them.
#include "plugins/ros2_robot/dds/topic_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <functional>

#include "plugins/ros2_robot/ros2_robot.hpp"
#include "tests/plugins/ros2_robot/network_robot.hpp"

namespace cairn::ros2_robot {
namespace {

using testing::HasSubstr;

// Two tests at once must not meet, nor those of other files.
int reported_domain() {
  return 200 + static_cast<int>(::getpid() % 30);
}

Config reported_config() {
  Config made;
  made.domain = reported_domain();
  made.network = Network::localhost;
  made.ranges = {{"/sonar", RangeKind::range, {}, 0}};
  return made;
}

RobotModel robot_with_one_sonar() {
  RobotModel robot;
  robot.sonars.resize(1);
  return robot;
}

std::string value_of(const ConnectionPart& part, const std::string& name) {
  const auto found = std::ranges::find(part.values, name, &ConnectionValue::name);
  return found == part.values.end() ? "" : found->text;
}

class TopicReports : public testing::Test {
 protected:
  // The part of that name once it is as it is waited for; 5 s at most.
  [[nodiscard]] static ConnectionPart part_of(live::BaseLink& link, const std::string& name,
                                              const std::function<bool(const ConnectionPart&)>& is_it) {
    std::string why;
    ConnectionPart last;
    (void)link.connect({}, why);
    for (const double begin_s = live::now_s(); live::now_s() - begin_s < 5.0;) {
      std::vector<Observation> seen;
      (void)link.receive(seen);
      const std::vector<ConnectionPart> parts = link.parts();
      const auto found = std::ranges::find(parts, name, &ConnectionPart::name);
      if (found == parts.end()) continue;
      last = *found;
      if (is_it(last)) return last;
    }
    return last;
  }
  [[nodiscard]] static ConnectionPart problem_of(const Config& config, const std::string& name,
                                                 const std::string& problem) {
    const auto link = link_to(config, robot_with_one_sonar());
    return part_of(*link, name,
                   [&](const ConnectionPart& part) { return part.problem.find(problem) != std::string::npos; });
  }

  NetworkRobot robot_{reported_domain()};
};

// Of a writer or a reader that ROS would make otherwise.
struct OwnQos {
  OwnQos() : qos(dds_create_qos()) {}
  ~OwnQos() { dds_delete_qos(qos); }
  OwnQos(const OwnQos&) = delete;
  OwnQos& operator=(const OwnQos&) = delete;
  dds_qos_t* qos;
};

dds_entity_t topic_of(dds_entity_t participant, const char* name, const dds_topic_descriptor_t& type) {
  return dds_create_topic(participant, &type, name, nullptr, nullptr);
}

TEST_F(TopicReports, SayTypeQualityRateAgeFrameAndClock) {
  const auto link = link_to(reported_config(), robot_with_one_sonar());
  const ConnectionPart odometry =
      part_of(*link, "/odom", [](const ConnectionPart& part) { return value_of(part, "rate").size() > 12; });
  EXPECT_EQ(odometry.problem, "");
  EXPECT_EQ(value_of(odometry, "type"), "nav_msgs/msg/Odometry");
  EXPECT_EQ(value_of(odometry, "offered"), "reliable, volatile");
  EXPECT_EQ(value_of(odometry, "wanted"), "best_effort, volatile");
  EXPECT_THAT(value_of(odometry, "rate"), HasSubstr(" a second"));
  EXPECT_THAT(value_of(odometry, "age"), HasSubstr(" s"));
  EXPECT_EQ(value_of(odometry, "frame"), "odom");
  EXPECT_THAT(value_of(odometry, "clock"), HasSubstr(" s of this computer's"));
  const ConnectionPart network =
      part_of(*link, "ROS domain " + std::to_string(reported_domain()), [](const ConnectionPart&) { return true; });
  EXPECT_EQ(value_of(network, "published"), "/odom, /sonar");
}

TEST_F(TopicReports, NameATopicThatNobodyPublishesWithTheNearest) {
  Config config = reported_config();
  config.ranges[0].topic = "/sonars";
  const ConnectionPart part = problem_of(config, "/sonars", "did you mean");
  EXPECT_EQ(part.problem, "nobody publishes it (did you mean \"/sonar\"?)");
  EXPECT_EQ(value_of(part, "published by"), "nobody");
}

TEST_F(TopicReports, NameATypeThatIsNotTheOneThatIsRead) {
  Config config = reported_config();
  config.ranges[0].kind = RangeKind::point_cloud;
  EXPECT_EQ(problem_of(config, "/sonar", "is published").problem,
            "sensor_msgs/msg/Range is published, and sensor_msgs/msg/PointCloud is read: see the topic's `type`");
}

TEST_F(TopicReports, NameThePolicyByWhichFramesDoNotFit) {
  const OwnQos best_effort;
  dds_qset_reliability(best_effort.qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  const Entity frames(dds_create_writer(robot_.handle(),
                                        topic_of(robot_.handle(), "rt/tf_static", tf2_msgs_msg_dds__TFMessage__desc),
                                        best_effort.qos, nullptr));
  const ConnectionPart part = problem_of(reported_config(), "/tf_static", "reliability");
  EXPECT_EQ(part.problem, "it does not fit, and nothing comes; reliability: best_effort is offered, reliable wanted");
  EXPECT_EQ(value_of(part, "offered"), "best_effort, volatile");
  EXPECT_EQ(value_of(part, "wanted"), "reliable, transient_local");
}

TEST_F(TopicReports, WithoutStaticFramesNothingIsWrong) {
  const auto link = link_to(reported_config(), robot_with_one_sonar());
  const ConnectionPart part = part_of(*link, "/tf_static", [](const ConnectionPart&) { return true; });
  EXPECT_EQ(part.problem, "");
  EXPECT_EQ(value_of(part, "published by"), "nobody");
}

TEST_F(TopicReports, NameATopicThatIsSilent) {
  robot_.is_sonar_silent = true;
  EXPECT_THAT(problem_of(reported_config(), "/sonar", "nothing comes").problem,
              HasSubstr("it is published, and nothing comes"));
}

TEST_F(TopicReports, DoNotCallATopicSilentThatWasNotReadYet) {
  Config config = reported_config();
  config.odometry = "/odo";
  const auto link = link_to(config, robot_with_one_sonar());
  const ConnectionPart part =
      part_of(*link, "/sonar", [](const ConnectionPart& sonar) { return !value_of(sonar, "heard").empty(); });
  EXPECT_EQ(part.problem, "");
  EXPECT_EQ(value_of(part, "heard"), "not read before the odometry is there");
}

TEST_F(TopicReports, ARobotToWhoseVelocitiesNobodyListensIsStopped) {
  const auto link = link_to(reported_config(), robot_with_one_sonar());
  std::string why;
  ASSERT_TRUE(link->connect({}, why)) << why;
  const auto stopped_by_within = [&](double within_s, bool wanted) {
    std::string stopped_by;
    for (const double begin_s = live::now_s(); live::now_s() - begin_s < within_s;) {
      std::vector<Observation> seen;
      (void)link->receive(seen);
      if (!seen.empty()) stopped_by = seen.back().stopped_by;
      if (!seen.empty() && stopped_by.empty() != wanted) break;
    }
    return stopped_by;
  };
  EXPECT_EQ(stopped_by_within(0.5, true), "") << "it may still be met";
  EXPECT_EQ(stopped_by_within(8.0, true), "a base that nobody has met: no one listens to /cmd_vel");
  const Entity base = robot_.participant().reader("/cmd_vel", geometry_msgs_msg_dds__Twist__desc);
  EXPECT_EQ(stopped_by_within(8.0, false), "");
}

TEST_F(TopicReports, NameReadingsWhoseClockIsNotTheOdometrys) {
  robot_.sonar_ahead_s = -7.0;
  EXPECT_THAT(problem_of(reported_config(), "/sonar", "behind those of /odom").problem,
              HasSubstr("its stamps are 7.0"));
}

TEST_F(TopicReports, SayWhoListensToVelocities) {
  EXPECT_EQ(problem_of(reported_config(), "/cmd_vel", "no base").problem,
            "no base listens to it: the robot would not move");
  const Entity listener = robot_.participant().reader("/cmd_vel", geometry_msgs_msg_dds__TwistStamped__desc);
  Config config = reported_config();
  config.command.kind = CommandKind::twist;
  EXPECT_EQ(problem_of(config, "/cmd_vel", "is wanted").problem,
            "geometry_msgs/msg/TwistStamped is wanted: set `command: {type: auto}`");
  const auto link = link_to(reported_config(), robot_with_one_sonar());
  const ConnectionPart heard =
      part_of(*link, "/cmd_vel", [](const ConnectionPart& part) { return part.problem.empty(); });
  EXPECT_EQ(heard.problem, "");
  EXPECT_EQ(value_of(heard, "heard by"), "1 subscriber");
  EXPECT_EQ(value_of(heard, "type"), "geometry_msgs/msg/TwistStamped");
  EXPECT_EQ(value_of(heard, "also published by"), "");
  const Entity joystick = robot_.participant().writer("/cmd_vel", geometry_msgs_msg_dds__Twist__desc);
  const ConnectionPart driven_by_two = part_of(
      *link, "/cmd_vel", [](const ConnectionPart& part) { return !value_of(part, "also published by").empty(); });
  EXPECT_EQ(value_of(driven_by_two, "also published by"), "1 participant");
}

TEST_F(TopicReports, NameThePolicyByWhichABaseHearsNothing) {
  const OwnQos hurried;
  dds_qset_deadline(hurried.qos, DDS_MSECS(100));
  const Entity base(dds_create_reader(robot_.handle(),
                                      topic_of(robot_.handle(), "rt/cmd_vel", geometry_msgs_msg_dds__Twist__desc),
                                      hurried.qos, nullptr));
  EXPECT_EQ(problem_of(reported_config(), "/cmd_vel", "deadline").problem,
            "who listens does not fit, and hears nothing; deadline: none is offered, 0.1 s wanted");
}

}  // namespace
}  // namespace cairn::ros2_robot
