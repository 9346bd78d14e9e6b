// From tables to observations: units, no-echo marks, poses by time stamp, and a rule for every bad line.
#pragma once

#include <string>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"
#include "plugins/table_log/config.hpp"

namespace cairn {

struct RecordedLog {
  std::vector<Observation> observations;  // in order of time; T_odom_robot begins at identity
  std::optional<Pose2> T_log_start;       // the first pose, in the frame of the log
  int skipped_lines = 0;
  std::string first_skipped;  // what was wrong with the first of them
};

// Reads everything at once. Ranges: a value of no_echo or one beyond max_m is +inf, nearer than min_m
// is -inf, negative or NaN is NaN. A bad line (too few columns, text or NaN where a number must be,
// time that goes backwards, no pose for its time) is refused with ConfigError at its file:line:column,
// or skipped and counted. Refused in any case: a file that cannot be read, a log without a single good
// line, columns that do not fit the sonars.
[[nodiscard]] RecordedLog read_log(const TableLogConfig& config, const RobotModel& robot);

}  // namespace cairn
