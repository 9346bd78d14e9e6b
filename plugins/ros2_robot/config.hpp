// Settings of `ros2_robot` (docs/your-robot.md).
#pragma once

#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/live/live_robot.hpp"

namespace cairn::ros2_robot {

enum class Network { any, localhost };
enum class RangeKind { range, laser, point_cloud, point_cloud2 };
enum class CompassKind { imu, magnetic_field };
enum class Mounting { agree, file, frames };
enum class Stamp { header, arrival };
enum class CommandKind { by_subscriber, twist, twist_stamped };

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

struct CommandTopic {
  std::string topic = "/cmd_vel";
  CommandKind kind = CommandKind::by_subscriber;
  std::string frame = "base_link";

  static void describe(Fields<CommandTopic>& fields);
};

// Where the mission is shown; an empty name: it is not.
struct ShownTopics {
  std::string map = "/cairn/map";
  std::string pose = "/cairn/pose";
  std::string plan = "/cairn/plan";
  std::string landmarks = "/cairn/landmarks";
  std::string diagnostics = "/diagnostics";
  bool tf = false;
  double map_every_s = 3.0;
  std::string map_frame = "map";

  static void describe(Fields<ShownTopics>& fields);
};

struct InitialPoseTopic {
  std::string topic;  // empty: the mission says where the robot begins
  double wait_s = 60.0;

  static void describe(Fields<InitialPoseTopic>& fields);
};

struct Config {
  int domain = 0;
  Network network = Network::any;
  std::string interface;           // empty: as the system chooses
  std::vector<std::string> peers;  // addresses that are asked besides multicast
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
  CommandTopic command;
  ShownTopics show;
  std::string goal;  // empty: none
  InitialPoseTopic initial_pose;
  double guard_s = 0.3;
  live::LiveRules stop_when;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::ros2_robot
