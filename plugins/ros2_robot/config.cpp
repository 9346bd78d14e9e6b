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
  fields.group("stop_when", &Config::stop_when, "when the wheels stop by themselves");
}

}  // namespace cairn::ros2_robot
