#include "plugins/table_log/table_log.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maps/base/text.hpp"
#include "plugins/common/logs/range_rule.hpp"

namespace cairn {
namespace {

using log_common::LogLine;
using log_common::ScanLog;

std::optional<char> mark_of(Separator separator) {
  if (separator == Separator::whitespace) return std::nullopt;
  return separator == Separator::comma ? ',' : separator == Separator::semicolon ? ';' : '\t';
}

double seconds_per(TimeUnit unit) {
  return unit == TimeUnit::seconds ? 1.0 : 1e-3;
}

double metres_per(LengthUnit unit) {
  if (unit == LengthUnit::metres) return 1.0;
  return unit == LengthUnit::centimetres ? 1e-2 : 1e-3;
}

double radians_per(AngleUnit unit) {
  if (unit == AngleUnit::radians) return 1.0;
  return radians(unit == AngleUnit::degrees ? 1.0 : 0.1);
}

// Calls read with each line of data.
template <class Read>
void read_rows(ScanLog& scans, const TableConfig& table, Read read) {
  const auto read_data = [&](const LogLine& row) {
    const bool is_comment = !table.comment.empty() && trimmed(row.text()).starts_with(table.comment);
    if (row.line() > table.skip_lines && !is_comment) read(row);
  };
  static_cast<void>(scans.read_lines(table.file, read_data, mark_of(table.separator)));
}

// The index of a column's word. Columns count from 1.
std::size_t word_of(const LogLine& row, int column, const std::string& what) {
  const auto word = static_cast<std::size_t>(column - 1);
  if (word >= row.size())
    throw ConfigError(row.place(word), "the line has " + std::to_string(row.size()) + " columns, but column " +
                                           std::to_string(column) + " is to be the " + what);
  return word;
}

std::string shown_column(const std::string& what, int column) {
  return what + " (column " + std::to_string(column) + ")";
}

double finite_in(const LogLine& row, int column, const std::string& what) {
  return row.finite(word_of(row, column, what), shown_column(what, column));
}

Pose2 pose_in(const LogLine& row, const TableConfig& table) {
  const double metres = metres_per(table.length_unit);
  Pose2 pose{metres * finite_in(row, table.x_column, "x"), metres * finite_in(row, table.y_column, "y"), 0.0};
  if (std::abs(pose.x_m) > log_common::kFarthest_m || std::abs(pose.y_m) > log_common::kFarthest_m)
    throw ConfigError(row.place(word_of(row, table.x_column, "x")), "a pose farther than 100 km from the log's origin");
  if (table.heading_column > 0)
    pose.theta_rad = wrap_angle(radians_per(table.angle_unit) * finite_in(row, table.heading_column, "heading"));
  return pose;
}

// Time of a row, not before the last good one.
class Clock {
 public:
  explicit Clock(const TableConfig& table) : column_(table.time_column), unit_s_(seconds_per(table.time_unit)) {}

  [[nodiscard]] double read(const LogLine& row) const {
    const double time_s = unit_s_ * finite_in(row, column_, "time");
    if (time_s < last_s_)
      throw ConfigError(place(row), "time goes backwards, from " + config_detail::number_text(last_s_) + " s to " +
                                        config_detail::number_text(time_s) + " s");
    return time_s;
  }
  void advance(double time_s) { last_s_ = time_s; }
  [[nodiscard]] SourcePlace place(const LogLine& row) const { return row.place(static_cast<std::size_t>(column_ - 1)); }

 private:
  int column_;
  double unit_s_;
  double last_s_ = -std::numeric_limits<double>::infinity();
};

struct StampedPose {
  double stamp_s;
  Pose2 T_log_robot;
};

std::vector<StampedPose> read_poses(const TableConfig& table, ScanLog& scans) {
  std::vector<StampedPose> poses;
  Clock clock(table);
  read_rows(scans, table, [&](const LogLine& row) {
    const double stamp_s = clock.read(row);
    poses.push_back({stamp_s, pose_in(row, table)});
    clock.advance(stamp_s);
  });
  return poses;
}

Pose2 pose_at(double stamp_s, const std::vector<StampedPose>& poses, PoseJoin join, const SourcePlace& place) {
  constexpr double kSameTime_s = 1e-6;
  const auto later = std::upper_bound(poses.begin(), poses.end(), stamp_s + kSameTime_s,
                                      [](double time_s, const StampedPose& pose) { return time_s < pose.stamp_s; });
  if (later == poses.begin()) {
    throw ConfigError(place, "no pose as early as " + config_detail::number_text(stamp_s) + " s in the table of poses");
  }
  const StampedPose& found = *std::prev(later);
  if (join == PoseJoin::equal && found.stamp_s < stamp_s - kSameTime_s) {
    throw ConfigError(place, "no pose at " + config_detail::number_text(stamp_s) +
                                 " s in the table of poses (`join: not_later` takes the one before)");
  }
  return found.T_log_robot;
}

std::vector<RangeReading> empty_readings(const TableLogConfig& config, const RobotModel& robot) {
  std::vector<RangeReading> readings;
  for (const LogSonar& s : config.sonars) {
    readings.push_back({{s.x_m, s.y_m, wrap_angle(s.angle_rad)}, s.half_beam_rad, s.min_m, s.max_m, 0.0, 0});
  }
  if (config.sonars.empty()) {
    for (const SonarModel& s : robot.sonars) {
      readings.push_back({s.T_robot_sonar, s.half_beam_rad, s.min_m, s.max_m, 0.0, 0});
    }
  }
  for (std::size_t i = 0; i < readings.size(); ++i) readings[i].sensor = static_cast<int>(i);
  return readings;
}

std::vector<int> range_columns(const TableLogConfig& config, std::size_t sonars) {
  std::vector<int> columns;
  for (const double column : config.range_columns) columns.push_back(static_cast<int>(column));
  if (columns.empty() && config.first_range_column > 0) {
    for (std::size_t i = 0; i < sonars; ++i) columns.push_back(config.first_range_column + static_cast<int>(i));
  }
  const SourcePlace place{config.file.string(), 0, 0};
  for (const double column : config.range_columns) {
    if (column != std::floor(column)) throw ConfigError(place, "range_columns must be whole numbers");
  }
  if (columns.size() != sonars) {
    throw ConfigError(place, std::to_string(columns.size()) +
                                 " range columns (range_columns or first_range_column) for " + std::to_string(sonars) +
                                 " sonars");
  }
  return columns;
}

// A pose is x and y together; a table of poses, and a join with one, need a time.
void check_columns(const TableLogConfig& config) {
  const auto check = [](const TableConfig& table, bool needs_time, bool needs_pose) {
    const SourcePlace place{table.file.string(), 0, 0};
    if ((table.x_column > 0) != (table.y_column > 0) || (table.heading_column > 0 && table.x_column == 0)) {
      throw ConfigError(place, "a pose needs both x_column and y_column");
    }
    if (needs_pose && table.x_column == 0) throw ConfigError(place, "a table of poses needs x_column and y_column");
    if (needs_time && table.time_column == 0) throw ConfigError(place, "joining poses by time needs time_column");
  };
  check(config, config.poses.has_value(), false);
  if (config.poses) check(*config.poses, true, true);
  const bool heading = config.poses ? config.poses->heading_column > 0 : config.heading_column > 0;
  if (config.compass_from_pose && !heading) {
    throw ConfigError({config.file.string(), 0, 0}, "compass_from_pose needs heading_column");
  }
}

}  // namespace

ScanLog read_table_log(const TableLogConfig& config, const RobotModel& robot, const Budget& budget) {
  check_columns(config);
  std::vector<RangeReading> readings = empty_readings(config, robot);
  const std::vector<int> columns = range_columns(config, readings.size());
  const double metres = metres_per(config.range_unit);
  ScanLog scans(config.file.string(), config, budget);
  const std::size_t source = scans.source("", [&] { return readings; });
  const auto poses = config.poses ? read_poses(*config.poses, scans) : std::vector<StampedPose>{};
  Clock clock(config);
  std::int64_t rows_so_far = 0;
  std::vector<double> ranges_m(columns.size());
  read_rows(scans, config, [&](const LogLine& row) {
    log_common::Scan scan;
    // Skipped lines took their time too.
    scan.stamp_s = config.time_column > 0 ? clock.read(row) : config.period_s * static_cast<double>(rows_so_far++);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::string what = "range " + std::to_string(i + 1);
      const double value = row.number(word_of(row, columns[i], what), shown_column(what, columns[i]));
      ranges_m[i] = log_common::range_from(value, metres, config.no_echo, readings[i].min_m, readings[i].max_m);
    }
    if (config.poses)
      scans.set_pose(pose_at(scan.stamp_s, poses, config.join, clock.place(row)), scan);
    else if (config.x_column > 0)
      scans.set_pose(pose_in(row, config), scan);
    clock.advance(scan.stamp_s);
    scans.add(scan, source, ranges_m);
  });
  scans.require_scans();
  return scans;
}

}  // namespace cairn
