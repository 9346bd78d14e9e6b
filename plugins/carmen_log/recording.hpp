// What `record:` writes beyond CARMEN: PARAM lines that make a log give back its observations to the
// last bit (docs/logs.md).
//
//   PARAM cairn_start x,y,theta                                     where the robot began, in the map
//   PARAM cairn_sensor_K sensor,x,y,theta,half_beam,min,max         one a transducer, before its first use
//   PARAM cairn_observation bumped,compass,K,K-K,... time host time
// The last begins an observation: its odometry is the ODOM line before it, its ranges are those of the
// SONAR and ROBOTLASER1 lines behind it, as many as it names sensors.
#pragma once

#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "plugins/common/logs/log_line.hpp"
#include "plugins/common/logs/scan_log.hpp"

namespace cairn::carmen_log {

class Recording {
 public:
  explicit Recording(log_common::ScanLog& scans) : scans_(scans) {}

  // All throw ConfigError when the line is not as above.
  void read_param(const log_common::LogLine& line);
  void read_odometry(const log_common::LogLine& line);
  void read_truth(const Pose2& true_T_map_robot) { truth_ = true_T_map_robot; }
  // Takes the ranges of a SONAR or ROBOTLASER1 line when an observation waits for them.
  [[nodiscard]] bool take_sonar(const log_common::LogLine& line) { return take_ranges(line, 2); }
  [[nodiscard]] bool take_scan(const log_common::LogLine& line) { return take_ranges(line, 8); }
  // At the end of an observation, and of the log: one that has not got all its ranges is a bad line.
  void check_complete(const SourcePlace& place);

 private:
  // count_at: the word with their number; they follow.
  [[nodiscard]] bool take_ranges(const log_common::LogLine& line, std::size_t count_at);
  void begin_observation(const log_common::LogLine& line);
  [[nodiscard]] std::vector<RangeReading> readings_of(std::string_view sensors, const SourcePlace& place) const;
  void complete();

  log_common::ScanLog& scans_;
  std::map<int, RangeReading> sensors_;
  Pose2 T_odom_robot_;
  std::optional<Pose2> truth_;
  std::optional<log_common::Scan> waiting_;
  std::size_t source_ = 0;
  std::vector<double> ranges_m_;  // of the one that waits, so far
};

}  // namespace cairn::carmen_log
