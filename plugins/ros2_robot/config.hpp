// Settings of `ros2_robot` (docs/your-robot.md).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugins/common/ros/settings.hpp"

namespace cairn::ros2_robot {

using ros::CompassKind;
using ros::CompassTopic;
using ros::Mounting;
using ros::RangeKind;
using ros::RangeTopic;
using ros::Stamp;

constexpr std::pair<int, int> kDomains{0, 232};  // the first and the last one

constexpr int kDomainOfEnvironment = -1;

enum class Network { environment, any, localhost };
enum class CommandKind { by_subscriber, twist, twist_stamped };

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

enum class ImageKind { raw, compressed };

// The pictures of a camera.
struct ImageTopic {
  std::string topic;
  ImageKind kind = ImageKind::raw;
  int camera = 0;  // number in the robot's file

  static void describe(Fields<ImageTopic>& fields);
};

struct Config : ros::RobotTopics {
  int domain = kDomainOfEnvironment;
  Network network = Network::environment;
  std::string interface;           // empty: as the system chooses
  std::vector<std::string> peers;  // addresses that are asked besides multicast; none: as the environment says
  std::vector<ImageTopic> images;
  CommandTopic command;
  ShownTopics show;
  std::string goal;  // empty: none
  InitialPoseTopic initial_pose;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::ros2_robot
