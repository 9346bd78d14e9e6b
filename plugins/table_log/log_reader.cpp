#include "plugins/table_log/log_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/common/logs/range_rule.hpp"
#include "plugins/table_log/table_file.hpp"

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

constexpr double kFarthest_m = 1e5;

Pose2 pose_in(const TableRow& row, const TableConfig& table) {
  const double metres = metres_per(table.length_unit);
  Pose2 pose{metres * row.finite_number(table.x_column, "x"), metres * row.finite_number(table.y_column, "y"), 0.0};
  if (std::abs(pose.x_m) > kFarthest_m || std::abs(pose.y_m) > kFarthest_m)
    throw ConfigError(row.place(table.x_column), "a pose farther than 100 km from the log's origin");
  if (table.heading_column > 0) {
    pose.theta_rad = wrap_angle(radians_per(table.angle_unit) * row.finite_number(table.heading_column, "heading"));
  }
  return pose;
}

// Reads rows one by one, refusing or counting the bad ones.
class LineRule {
 public:
  LineRule(BadLine rule, RecordedLog& log) : rule_(rule), log_(log) {}

  template <class Read>
  void read(const TableFile& file, Read read_row) {
    for (const TableRow& row : file.rows()) {
      try {
        read_row(row);
      } catch (const ConfigError& error) {
        if (rule_ == BadLine::refuse) throw;
        if (log_.skipped_lines++ == 0) log_.first_skipped = error.what();
      }
    }
  }

 private:
  BadLine rule_;
  RecordedLog& log_;
};

// Time of a row, not before the last good one.
class Clock {
 public:
  explicit Clock(const TableConfig& table) : column_(table.time_column), unit_s_(seconds_per(table.time_unit)) {}

  [[nodiscard]] double read(const TableRow& row) const {
    const double time_s = unit_s_ * row.finite_number(column_, "time");
    if (time_s < last_s_) {
      throw ConfigError(row.place(column_), "time goes backwards, from " + config_detail::number_text(last_s_) +
                                                " s to " + config_detail::number_text(time_s) + " s");
    }
    return time_s;
  }
  void advance(double time_s) { last_s_ = time_s; }

 private:
  int column_;
  double unit_s_;
  double last_s_ = -kInfinity;
};

struct StampedPose {
  double stamp_s;
  Pose2 T_log_robot;
};

std::vector<StampedPose> read_poses(const TableConfig& table, LineRule& rule) {
  const TableFile file(table);
  std::vector<StampedPose> poses;
  Clock clock(table);
  rule.read(file, [&](const TableRow& row) {
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

// Odometry from the first pose on; the heading in the log's frame stands in for a compass.
void set_pose(const Pose2& T_log_robot, const TableLogConfig& config, RecordedLog& log, Observation& seen) {
  if (!log.T_log_start) log.T_log_start = T_log_robot;
  const Pose2& first = *log.T_log_start;
  // The difference before the turn, so that the first pose is identity to the last bit.
  seen.T_odom_robot = Pose2{0.0, 0.0, -first.theta_rad} *
                      Pose2{T_log_robot.x_m - first.x_m, T_log_robot.y_m - first.y_m, T_log_robot.theta_rad};
  if (config.compass_from_pose) seen.compass_rad = T_log_robot.theta_rad;
}

}  // namespace

RecordedLog read_log(const TableLogConfig& config, const RobotModel& robot) {
  check_columns(config);
  const std::vector<RangeReading> readings = empty_readings(config, robot);
  const std::vector<int> columns = range_columns(config, readings.size());
  const double metres = metres_per(config.range_unit);
  RecordedLog log;
  LineRule rule(config.on_bad_line, log);
  const std::vector<StampedPose> poses = config.poses ? read_poses(*config.poses, rule) : std::vector<StampedPose>{};
  const TableFile file(config);
  Clock clock(config);
  std::int64_t rows_so_far = 0;
  rule.read(file, [&](const TableRow& row) {
    Observation seen;
    // Skipped lines took their time too.
    seen.stamp_s = config.time_column > 0 ? clock.read(row) : config.period_s * static_cast<double>(rows_so_far++);
    seen.ranges = readings;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double value = row.number(columns[i], "range " + std::to_string(i + 1));
      RangeReading& reading = seen.ranges[i];
      reading.range_m = log_common::range_from(value, metres, config.no_echo, reading.min_m, reading.max_m);
    }
    if (config.poses) {
      set_pose(pose_at(seen.stamp_s, poses, config.join, row.place(config.time_column)), config, log, seen);
    } else if (config.x_column > 0) {
      set_pose(pose_in(row, config), config, log, seen);
    }
    clock.advance(seen.stamp_s);
    log.observations.push_back(std::move(seen));
  });
  if (log.observations.empty()) {
    throw ConfigError({file.name(), 0, 0}, "the log holds no observation" +
                                               (log.skipped_lines > 0 ? "; first bad line: " + log.first_skipped : ""));
  }
  return log;
}

}  // namespace cairn
