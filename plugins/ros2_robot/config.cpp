#include "plugins/ros2_robot/config.hpp"

namespace cairn::ros2_robot {

void CommandTopic::describe(Fields<CommandTopic>& fields) {
  fields.text("topic", &CommandTopic::topic, "where velocities are sent to");
  fields.choice("type", &CommandTopic::kind,
                {{"auto", CommandKind::by_subscriber},
                 {"twist", CommandKind::twist},
                 {"twist_stamped", CommandKind::twist_stamped}},
                "geometry_msgs/Twist or TwistStamped; auto: as who subscribes to it");
  fields.text("frame", &CommandTopic::frame, "frame_id of a TwistStamped");
}

void ShownTopics::describe(Fields<ShownTopics>& fields) {
  fields.text("map", &ShownTopics::map, "nav_msgs/OccupancyGrid; empty: not shown");
  fields.text("pose", &ShownTopics::pose, "geometry_msgs/PoseWithCovarianceStamped; empty: not shown");
  fields.text("plan", &ShownTopics::plan, "nav_msgs/Path that is being driven; empty: not shown");
  fields.text("landmarks", &ShownTopics::landmarks, "visualization_msgs/MarkerArray; empty: not shown");
  fields.text("diagnostics", &ShownTopics::diagnostics,
              "diagnostic_msgs/DiagnosticArray, once a second; empty: not shown");
  fields.flag("tf", &ShownTopics::tf,
              "publishes where the odometry's frame is in the map on /tf: only when nobody else does");
  fields.number("map_every_s", &ShownTopics::map_every_s, {0.5, 600.0}, "s",
                "a map that has changed is not sent more often");
  fields.text("map_frame", &ShownTopics::map_frame, "frame_id of all that is shown, and of goals");
}

void ImageTopic::describe(Fields<ImageTopic>& fields) {
  fields.text("topic", &ImageTopic::topic, "its full name, as /camera/image_raw").required = true;
  fields.choice("type", &ImageTopic::kind, {{"raw", ImageKind::raw}, {"compressed", ImageKind::compressed}},
                "sensor_msgs/Image, or sensor_msgs/CompressedImage (JPEG, PNG)");
  fields.integer("camera", &ImageTopic::camera, {0, 15}, "number in the robot's file, from 0");
}

void InitialPoseTopic::describe(Fields<InitialPoseTopic>& fields) {
  fields.text("topic", &InitialPoseTopic::topic,
              "geometry_msgs/PoseWithCovarianceStamped where the robot begins, as /initialpose; empty: as the mission "
              "says");
  fields.number("wait_s", &InitialPoseTopic::wait_s, {1.0, 3600.0}, "s", "a mission without it by then does not begin");
}

void Config::describe(Fields<Config>& fields) {
  fields
      .integer("domain", &Config::domain, {kDomains.first, kDomains.second},
               "the ROS domain; without it the environment's ROS_DOMAIN_ID, else 0")
      .default_text.clear();
  fields.choice("network", &Config::network,
                {{"environment", Network::environment}, {"any", Network::any}, {"localhost", Network::localhost}},
                "localhost: this computer, and the peers; environment: as ROS_AUTOMATIC_DISCOVERY_RANGE and "
                "ROS_LOCALHOST_ONLY say, else any");
  fields.text("interface", &Config::interface, "name of the network interface, as wlan0; empty: as the system chooses");
  fields.texts("peers", &Config::peers,
               "addresses of computers that are asked besides multicast; without them those of the environment's "
               "ROS_STATIC_PEERS");
  ros::describe_topics(fields);
  fields.list("images", &Config::images, "topics of pictures; read only by missions with `markers`");
  fields.group("command", &Config::command, "velocities");
  fields.group("show", &Config::show, "topics that show the mission to people");
  fields.text("goal", &Config::goal,
              "geometry_msgs/PoseStamped, as /goal_pose: orders for a mission that awaits them; empty: none");
  fields.group("initial_pose", &Config::initial_pose, "a start that people give");
  ros::describe_stops(fields);
}

}  // namespace cairn::ros2_robot
