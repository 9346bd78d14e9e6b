#include "plugins/table_log/table_log.hpp"

namespace cairn {

TableLog::TableLog(const TableLogConfig& config, const RobotModel& robot)
    : name_(config.file.filename().string()), log_(read_log(config, robot)) {}

SensorStep TableLog::next(const Budget&) {
  SensorStep step;
  if (next_ < log_.observations.size()) {
    step.state = SensorState::observation;
    step.observation = log_.observations[next_++];
    return step;
  }
  step.reason = "end of " + name_ + " after " + std::to_string(next_) + " observations";
  if (log_.skipped_lines > 0) {
    step.reason += "; " + std::to_string(log_.skipped_lines) + " bad lines skipped, the first: " + log_.first_skipped;
  }
  return step;
}

}  // namespace cairn
