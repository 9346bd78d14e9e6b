#include "plugins/ros2_robot/config.hpp"

namespace cairn::ros2_robot {

void RangeTopic::describe(Fields<RangeTopic>& fields) {
  fields.text("topic", &RangeTopic::topic, "its full name, as /sonar or /robot1/scan");
  fields.choice("type", &RangeTopic::kind,
                {{"range", RangeKind::range},
                 {"laser", RangeKind::laser},
                 {"pointcloud", RangeKind::point_cloud},
                 {"pointcloud2", RangeKind::point_cloud2}},
                "sensor_msgs/Range, LaserScan, PointCloud or PointCloud2; a cloud has a point a sonar, in the order of "
                "the robot's file");
  fields.texts("frames", &RangeTopic::frames,
               "of a topic with several sonars: the frame_id of each, in the order of the robot's file");
  fields.integer("first", &RangeTopic::first, {0, 4095},
                 "number in the robot's file of its first sonar, or of its laser");
}

void CompassTopic::describe(Fields<CompassTopic>& fields) {
  fields.text("topic", &CompassTopic::topic, "what is believed as a compass; empty: none");
  fields.choice("type", &CompassTopic::kind, {{"imu", CompassKind::imu}, {"magnetic", CompassKind::magnetic_field}},
                "the orientation of a sensor_msgs/Imu, or a sensor_msgs/MagneticField of a level robot");
  fields.angle("offset_deg", &CompassTopic::offset_rad, {-360.0, 360.0}, "heading in the map when it says 0");
}

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

void InitialPoseTopic::describe(Fields<InitialPoseTopic>& fields) {
  fields.text("topic", &InitialPoseTopic::topic,
              "geometry_msgs/PoseWithCovarianceStamped where the robot begins, as /initialpose; empty: as the mission "
              "says");
  fields.number("wait_s", &InitialPoseTopic::wait_s, {1.0, 3600.0}, "s", "a mission without it by then does not begin");
}

void Config::describe(Fields<Config>& fields) {
  fields.integer("domain", &Config::domain, {0, 232}, "as ROS_DOMAIN_ID");
  fields.choice("network", &Config::network, {{"any", Network::any}, {"localhost", Network::localhost}},
                "localhost: this computer only");
  fields.text("interface", &Config::interface, "name of the network interface, as wlan0; empty: as the system chooses");
  fields.texts("peers", &Config::peers, "addresses of computers that are asked besides multicast");
  fields.text("odometry", &Config::odometry, "nav_msgs/Odometry");
  fields.list("ranges", &Config::ranges, "topics with ranges");
  fields.group("compass", &Config::compass, "an orientation that is believed");
  fields.text("battery", &Config::battery, "sensor_msgs/BatteryState; empty: none");
  fields.texts("bumpers", &Config::bumpers, "std_msgs/Bool each, true: something is touched");
  fields.text("emergency", &Config::emergency, "std_msgs/Bool, true: the wheels stand; empty: none");
  fields.number("no_echo_from_m", &Config::no_echo_from_m, {0.5, 1000.0}, "m", "a range from there on means no echo");
  fields.text("static_frames", &Config::static_frames,
              "tf2_msgs/TFMessage with where sensors are mounted; empty: it is not read");
  fields.text("base_frame", &Config::base_frame, "the robot's frame in it; empty: the child_frame_id of the odometry");
  fields.choice("mounting", &Config::mounting,
                {{"agree", Mounting::agree}, {"file", Mounting::file}, {"frames", Mounting::frames}},
                "where sensors are: the robot's file, and static frames that say otherwise are a fault; the file "
                "alone; the static frames alone");
  fields.choice("stamp", &Config::stamp, {{"header", Stamp::header}, {"arrival", Stamp::arrival}},
                "whose time counts: the messages' or when they came");
  fields.group("command", &Config::command, "velocities");
  fields.group("show", &Config::show, "topics that show the mission to people");
  fields.text("goal", &Config::goal,
              "geometry_msgs/PoseStamped, as /goal_pose: orders for a mission that awaits them; empty: none");
  fields.group("initial_pose", &Config::initial_pose, "a start that people give");
  fields.number("guard_s", &Config::guard_s, {0.1, 2.0}, "s",
                "a process of its own stops the wheels when this one gives no sign of life for so long");
  fields.group("stop_when", &Config::stop_when, "when the wheels stop by themselves");
}

}  // namespace cairn::ros2_robot
