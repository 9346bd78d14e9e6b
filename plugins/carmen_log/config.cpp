#include "plugins/carmen_log/config.hpp"

namespace cairn::carmen_log {

void LaserConfig::describe(Fields<LaserConfig>& fields) {
  fields.number("x_m", &LaserConfig::x_m, {-10, 10}, "m",
                "ahead of the robot's centre; left out: the log's PARAM robot_frontlaser_offset or "
                "robot_rearlaser_offset, or 0");
  fields.number("y_m", &LaserConfig::y_m, {-10, 10}, "m", "to the left of the robot's centre");
  fields.angle("angle_deg", &LaserConfig::angle_rad, {-360, 360},
               "which way it looks; left out: 0 for the front laser, 180 for the rear one");
  fields.angle("first_angle_deg", &LaserConfig::first_angle_rad, {-360, 360},
               "of the first beam; left out: -90, or what a ROBOTLASER line says");
  fields.angle("step_deg", &LaserConfig::step_rad, {-90, 90},
               "from beam to beam; left out: 1 for 180 and 181 beams, 0.5 for 360 and 361, otherwise so that the last "
               "beam is at 90, or what a ROBOTLASER line says");
  fields.angle("half_beam_deg", &LaserConfig::half_beam_rad, {0, 90}, "half the width of a beam; 0: a ray");
  fields.number("min_m", &LaserConfig::min_m, {0, 100}, "m", "shortest range");
  fields.number("max_m", &LaserConfig::max_m, {0.01, 1000}, "m",
                "longest range, what is beyond is no echo; left out: what the ROBOTLASER line says, the log's PARAM "
                "robot_front_laser_max or robot_rear_laser_max, or 80");
}

void SonarConfig::describe(Fields<SonarConfig>& fields) {
  fields.angle("half_beam_deg", &SonarConfig::half_beam_rad, {0, 90},
               "half the width of the beam; left out: half the line's cone angle");
  fields.number("min_m", &SonarConfig::min_m, {0, 100}, "m", "shortest range");
  fields.number("max_m", &SonarConfig::max_m, {0.01, 1000}, "m", "longest range, what is beyond is no echo");
}

void Config::describe(Fields<Config>& fields) {
  fields.file("file", &Config::file, "the log, plain or gzip").required = true;
  fields.texts(
      "lines", &Config::lines,
      "kinds of lines whose ranges are read, of FLASER, RLASER, ROBOTLASER1, ROBOTLASER2, SONAR; left out: all");
  fields.choice("poses", &Config::poses, {{"log", Poses::log}, {"odometry", Poses::odometry}},
                "what the localizer gets as odometry: the poses of the laser lines, corrected ones in a corrected log, "
                "or the odometry beside them");
  fields.numbers("no_echo", &Config::no_echo, {}, "", "values, as they stand in the log, that mean no echo");
  fields.choice("no_echo_means", &Config::no_echo_means, {{"silence", NoEcho::silence}, {"nothing", NoEcho::nothing}},
                "what no echo says: the beam is free, or nothing (a laser's lost beams)");
  fields.group("laser", &Config::laser, "the front laser: FLASER, ROBOTLASER1");
  fields.group("rear_laser", &Config::rear_laser, "the rear laser: RLASER, ROBOTLASER2");
  fields.group("sonar", &Config::sonar, "the sonars: SONAR");
  LogRules::describe_rules(fields);
}

}  // namespace cairn::carmen_log
