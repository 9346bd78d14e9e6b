#include "plugins/mcap_log/config.hpp"

namespace cairn::mcap_log {

void FramePlace::describe(Fields<FramePlace>& fields) {
  fields.text("frame", &FramePlace::frame, "frame_id of its messages").required = true;
  fields.number("x_m", &FramePlace::x_m, {-100, 100}, "m", "ahead of the robot's centre");
  fields.number("y_m", &FramePlace::y_m, {-100, 100}, "m", "to the left of the robot's centre");
  fields.angle("angle_deg", &FramePlace::angle_rad, {-360, 360}, "which way it looks");
}

void SonarConfig::describe(Fields<SonarConfig>& fields) {
  fields.angle("half_beam_deg", &SonarConfig::half_beam_rad, {0, 90},
               "half the width of the beam; left out: half the message's field_of_view");
  fields.number("min_m", &SonarConfig::min_m, {0, 100}, "m", "shortest range; left out: the message's min_range");
  fields.number("max_m", &SonarConfig::max_m, {0.01, 1000}, "m",
                "longest range, what is beyond is no echo; left out: the message's max_range");
}

void ImageTopic::describe(Fields<ImageTopic>& fields) {
  fields.text("topic", &ImageTopic::topic, "of sensor_msgs/msg/Image or CompressedImage (JPEG, PNG)").required = true;
  fields.integer("camera", &ImageTopic::camera, {0, 15}, "number in the robot's file, from 0");
}

void Config::describe(Fields<Config>& fields) {
  fields.file("file", &Config::file, "the log, plain or gzip").required = true;
  fields.texts("ranges", &Config::ranges,
               "topics of sensor_msgs/msg/Range and LaserScan; left out: the only LaserScan, or all of Range");
  fields.text("odometry", &Config::odometry,
              "topic of nav_msgs/msg/Odometry, or of tf2_msgs/msg/TFMessage for the transforms from odometry_frame, or "
              "`none`; empty: the only Odometry, or else the transforms");
  fields.text("compass", &Config::compass, "topic of sensor_msgs/msg/Imu that is believed as a compass; empty: none");
  fields.angle("compass_offset_deg", &Config::compass_offset_rad, {-360, 360}, "heading in the map when it says 0");
  fields.text("odometry_frame", &Config::odometry_frame, "in which transforms say where the robot is");
  fields.text("base_frame", &Config::base_frame, "the robot's frame; empty: the child frame of the odometry");
  fields.list("frames", &Config::frames, "where sensors are, instead of what the transforms say");
  fields.list("images", &Config::images,
              "topics of pictures, for missions with `markers`; left out: the only topic of pictures is camera 0");
  fields.choice("stamp", &Config::stamp, {{"header", Stamp::header}, {"log", Stamp::log}},
                "whose time counts: the messages' (the recorder's where that is 0) or the recorder's");
  fields.group("sonar", &Config::sonar, "what wins over what Range messages say");
  fields.group("laser", &Config::laser, "what wins over what LaserScan messages say");
  LogRules::describe_rules(fields);
}

}  // namespace cairn::mcap_log
