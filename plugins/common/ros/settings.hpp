// Settings that robots have that speak ROS's messages, whatever the way to them (docs/your-robot.md).
#pragma once

#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/live/live_robot.hpp"

namespace cairn::ros {

enum class RangeKind { range, laser, point_cloud, point_cloud2 };
enum class CompassKind { imu, magnetic_field };
enum class Mounting { agree, file, frames };
enum class Stamp { header, arrival };

struct RangeTopic {
  std::string topic;
  RangeKind kind = RangeKind::range;
  std::vector<std::string> frames;  // of a topic with several sensors, in their order
  int first = 0;                    // number in the robot's file of the first of them: a sonar's, or a laser's

  static void describe(Fields<RangeTopic>& fields);
};

struct CompassTopic {
  std::string topic;  // empty: none
  CompassKind kind = CompassKind::imu;
  double offset_rad = 0.0;

  static void describe(Fields<CompassTopic>& fields);
};

// What a robot is seen by. The settings of a module begin with it.
struct RobotTopics {
  std::string odometry = "/odom";
  std::vector<RangeTopic> ranges;
  CompassTopic compass;
  std::string battery;
  std::vector<std::string> bumpers;
  std::string emergency;
  double no_echo_from_m = 1000.0;
  std::string static_frames = "/tf_static";  // empty: not read
  std::string base_frame;                    // empty: as the odometry's child_frame_id
  Mounting mounting = Mounting::agree;
  Stamp stamp = Stamp::header;

  double guard_s = 0.3;
  live::LiveRules stop_when;
};

// The member of a base as one of the struct that has it.
template <class Config, class Value>
[[nodiscard]] constexpr Value Config::*member_of(Value RobotTopics::*member) {
  return member;
}

template <class Config>
void describe_topics(Fields<Config>& fields) {
  fields.text("odometry", &Config::odometry, "nav_msgs/Odometry");
  fields.list("ranges", member_of<Config>(&RobotTopics::ranges), "topics with ranges");
  fields.group("compass", member_of<Config>(&RobotTopics::compass), "an orientation that is believed");
  fields.text("battery", &Config::battery, "sensor_msgs/BatteryState; empty: none");
  fields.texts("bumpers", &Config::bumpers, "std_msgs/Bool each, true: something is touched");
  fields.text("emergency", &Config::emergency, "std_msgs/Bool, true: the wheels stand; empty: none");
  fields.number("no_echo_from_m", &Config::no_echo_from_m, {0.5, 1000.0}, "m", "a range from there on means no echo");
  fields.text("static_frames", &Config::static_frames,
              "tf2_msgs/TFMessage with where sensors are mounted; empty: it is not read");
  fields.text("base_frame", &Config::base_frame, "the robot's frame in it; empty: the child_frame_id of the odometry");
  fields.choice("mounting", member_of<Config>(&RobotTopics::mounting),
                {{"agree", Mounting::agree}, {"file", Mounting::file}, {"frames", Mounting::frames}},
                "where sensors are: the robot's file, and static frames that say otherwise are a fault; the file "
                "alone; the static frames alone");
  fields.choice("stamp", member_of<Config>(&RobotTopics::stamp),
                {{"header", Stamp::header}, {"arrival", Stamp::arrival}},
                "whose time counts: the messages' or when they came");
}

template <class Config>
void describe_stops(Fields<Config>& fields) {
  fields.number("guard_s", &Config::guard_s, {0.1, 2.0}, "s",
                "a process of its own stops the wheels when this one gives no sign of life for so long");
  fields.group("stop_when", member_of<Config>(&RobotTopics::stop_when), "when the wheels stop by themselves");
}

// Throws std::invalid_argument with the module, the setting, and what a topic's name should be.
void check_topic(const char* module, const char* key, const std::string& topic, bool may_be_empty);
// The same for all of these, against the robot's file.
void check_topics(const char* module, const RobotTopics& topics, const RobotModel& robot);

}  // namespace cairn::ros
