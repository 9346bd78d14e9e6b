// A recorded table of readings, played back. Plugin `table_log`, kind sensor; nothing to drive.
//
// Units, no-echo marks, poses by time stamp, and a rule for every bad line.
#pragma once

#include "framework/contracts/robot_model.hpp"
#include "plugins/table_log/config.hpp"

namespace cairn {

// Reads everything at once. Ranges: a value of no_echo or one beyond max_m is +inf, nearer than min_m
// is -inf, negative or NaN is NaN. A bad line (too few columns, text or NaN where a number must be,
// time that goes backwards, no pose for its time, more than 1 MiB, damaged compression) is refused with
// ConfigError at its file:line:column, or skipped and counted. Refused in any case: a file that cannot be
// read, a log without a single good line, columns that do not fit the sonars.
[[nodiscard]] log_common::ScanLog read_table_log(const TableLogConfig& config, const RobotModel& robot,
                                                 const Budget& budget = {});

class TableLog final : public log_common::ScanPlayer {
 public:
  TableLog(const TableLogConfig& config, const RobotModel& robot, const Budget& budget = {})
      : ScanPlayer(read_table_log(config, robot, budget)) {}

  [[nodiscard]] const GroundTruthSource* truth() const override { return nullptr; }
};

}  // namespace cairn
