// Settings of `rosbridge_robot` (docs/your-robot.md).
#pragma once

#include <string>

#include "plugins/common/ros/settings.hpp"

namespace cairn::rosbridge_robot {

enum class CommandKind { twist, twist_stamped };
enum class NullRange { bad, no_echo };

struct CommandTopic {
  std::string topic = "/cmd_vel";
  CommandKind kind = CommandKind::twist;
  std::string frame = "base_link";

  static void describe(Fields<CommandTopic>& fields);
};

struct Config : ros::RobotTopics {
  std::string host = "localhost";
  int port = 9090;
  std::string path = "/";
  int ros = 2;
  NullRange null_range = NullRange::bad;
  int scan_every_ms = 0;  // a laser's scans are not sent more often
  int max_message_kib = 1024;
  CommandTopic command;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::rosbridge_robot
