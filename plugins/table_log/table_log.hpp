// A recorded table of readings, played back. Plugin `table_log`, kind sensor; nothing to drive.
#pragma once

#include "framework/contracts/sensor.hpp"
#include "plugins/table_log/log_reader.hpp"

namespace cairn {

class TableLog final : public Sensor {
 public:
  // Reads the whole log; throws ConfigError as read_log does.
  TableLog(const TableLogConfig& config, const RobotModel& robot);

  // One observation a row, then end of data with the count of rows and of skipped lines.
  SensorStep next(const Budget& budget) override;
  // The log's first pose in the log's frame, which is the map's; nothing without poses.
  [[nodiscard]] std::optional<Pose2> start() const override { return log_.T_log_start; }

 private:
  std::string name_;
  RecordedLog log_;
  std::size_t next_ = 0;
};

}  // namespace cairn
