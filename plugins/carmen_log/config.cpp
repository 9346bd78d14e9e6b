#include "plugins/carmen_log/config.hpp"

namespace cairn::carmen_log {

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
                "or the odometry beside them: the edges between the scans where the log holds a pose graph");
  fields.group("laser", &Config::laser, "the front laser: FLASER, ROBOTLASER1");
  fields.group("rear_laser", &Config::rear_laser, "the rear laser: RLASER, ROBOTLASER2");
  fields.group("sonar", &Config::sonar, "the sonars: SONAR");
  LogRules::describe_rules(fields);
}

}  // namespace cairn::carmen_log
