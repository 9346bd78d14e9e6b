#include "plugins/rosbridge_robot/config.hpp"

namespace cairn::rosbridge_robot {

void CommandTopic::describe(Fields<CommandTopic>& fields) {
  fields.text("topic", &CommandTopic::topic, "where velocities are sent to");
  fields.choice("type", &CommandTopic::kind,
                {{"twist", CommandKind::twist}, {"twist_stamped", CommandKind::twist_stamped}},
                "geometry_msgs/Twist or TwistStamped, as the base wants it");
  fields.text("frame", &CommandTopic::frame, "frame_id of a TwistStamped");
}

void Config::describe(Fields<Config>& fields) {
  fields.text("host", &Config::host, "the computer on which rosbridge_server runs: its name or its address");
  fields.integer("port", &Config::port, {1, 65535}, "its port");
  fields.text("path", &Config::path, "its path, as rosbridge's url_path");
  fields.integer("ros", &Config::ros, {1, 2}, "ROS 1 or 2: they name types otherwise");
  ros::describe_topics(fields);
  fields.choice("null_range", &Config::null_range, {{"bad", NullRange::bad}, {"no_echo", NullRange::no_echo}},
                "what a range is that comes as null: rosbridge sends both infinity and NaN so");
  fields.integer("scan_every_ms", &Config::scan_every_ms, {0, 1000},
                 "a laser's scans are not sent more often; 0: all of them");
  fields.integer("max_message_kib", &Config::max_message_kib, {16, 65536},
                 "a longer message ends the connection, in KiB");
  fields.group("command", &Config::command, "velocities");
  ros::describe_stops(fields);
}

}  // namespace cairn::rosbridge_robot
