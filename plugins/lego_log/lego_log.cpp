#include "plugins/lego_log/lego_log.hpp"

#include <algorithm>
#include <cmath>

#include "plugins/common/logs/log_line.hpp"

namespace cairn::lego_log {
namespace {

using log_common::LogLine;
using log_common::ScanLog;

constexpr double kMetres_per_unit = 0.001;
constexpr double kSeconds_per_unit = 0.001;
constexpr std::size_t kLeftWord = 2;
constexpr std::size_t kRightWord = 6;
constexpr double kMaxTicks = 1e12;  // differences of what is beyond lose whole ticks

class Reader {
 public:
  Reader(const Config& config, double start_heading_rad, const Budget& budget)
      : config_(config),
        start_heading_rad_(start_heading_rad),
        scans_(config.file.string(), config, budget),
        wheel_path_(config.wheels) {
    log_common::check_limits(config.file, "laser", config.laser);
  }
  ScanLog read();

 private:
  // Calls take with each line of this kind.
  void read_lines(const std::filesystem::path& file, std::string_view kind, void (Reader::*take)(const LogLine&));
  void take_motors(const LogLine& line);
  void take_scan(const LogLine& line);
  std::size_t source_of(std::size_t beams);

  const Config& config_;
  double start_heading_rad_;
  ScanLog scans_;
  WheelPath wheel_path_;
  std::optional<Pose2> T_first_start_;  // of the wheels' path, where the first scan was taken
  std::size_t beams_ = 0;
  std::vector<double> ranges_m_;
};

double ticks_in(const LogLine& line, std::size_t word, const std::string& what) {
  const double ticks = line.finite(word, what);
  if (std::abs(ticks) > kMaxTicks)
    throw ConfigError(line.place(word), "the " + what + " are beyond 1e12: " + in_quotes(line.word(word)));
  return ticks;
}

double stamp_in(const LogLine& line) {
  return kSeconds_per_unit * line.finite(1, "time stamp");
}

// Any number but a finite one beyond kFarthest_m.
double range_in(const LogLine& line, std::size_t word) {
  const double range_m = kMetres_per_unit * line.number(word, "range");
  if (std::isfinite(range_m) && std::abs(range_m) > log_common::kFarthest_m)
    throw ConfigError(line.place(word), "the range is beyond 100 km: " + in_quotes(line.word(word)));
  return range_m;
}

void Reader::read_lines(const std::filesystem::path& file, std::string_view kind,
                        void (Reader::*take)(const LogLine&)) {
  static_cast<void>(scans_.read_lines(file, [&](const LogLine& line) {
    if (line.word(0) == kind)
      (this->*take)(line);
    else
      scans_.unknown_line(line.word(0));
  }));
}

void Reader::take_motors(const LogLine& line) {
  const double stamp_s = stamp_in(line);
  const double left_ticks = ticks_in(line, kLeftWord, "left wheel's ticks");
  const double right_ticks = ticks_in(line, kRightWord, "right wheel's ticks");
  if (!wheel_path_.empty() && stamp_s < wheel_path_.last_stamp_s())
    throw ConfigError(line.place(1), "the motors' time goes back to " + in_quotes(line.word(1)));
  wheel_path_.add(stamp_s, left_ticks, right_ticks);
}

std::size_t Reader::source_of(std::size_t beams) {
  const log_common::Fan fan = log_common::usual_fan(config_.laser, beams);
  return scans_.source(log_common::key_of(fan, beams),
                       [&] { return log_common::readings_of(fan, beams, config_.laser, 0); });
}

void Reader::take_scan(const LogLine& line) {
  constexpr std::size_t kFirstRange = 3;
  const std::size_t beams = line.count(2, "number of ranges");
  if (beams == 0 || line.size() != kFirstRange + beams)
    throw ConfigError(line.place(2), "the line holds " +
                                         std::to_string(line.size() - std::min(line.size(), kFirstRange)) +
                                         " ranges, not " + in_quotes(line.word(2)));
  if (beams_ != 0 && beams != beams_)
    throw ConfigError(line.place(2),
                      "the scans before had " + std::to_string(beams_) + " ranges, not " + in_quotes(line.word(2)));
  log_common::Scan scan;
  scan.stamp_s = stamp_in(line);
  scan.line = line.line();
  const std::size_t source = source_of(beams);
  ranges_m_.clear();
  for (std::size_t i = 0; i < beams; ++i) {
    const double range_m = range_in(line, kFirstRange + i);
    const RangeReading& reading = scans_.readings_of(source)[i];
    const double recorded_m = log_common::recorded_range(range_m, config_, reading);
    ranges_m_.push_back(
        std::isfinite(recorded_m)
            ? std::clamp(config_.range_ratio * recorded_m + config_.range_offset_m, reading.min_m, reading.max_m)
            : recorded_m);
  }
  const Pose2 T_first_robot = wheel_path_.at(scan.stamp_s);
  if (!T_first_start_) T_first_start_ = T_first_robot;
  scan.T_odom_robot = inverse(*T_first_start_) * T_first_robot;
  if (config_.compass_from_pose) scan.compass_rad = wrap_angle(start_heading_rad_ + scan.T_odom_robot.theta_rad);
  scans_.add(scan, source, ranges_m_);
  beams_ = beams;
}

ScanLog Reader::read() {
  read_lines(config_.motors, "M", &Reader::take_motors);
  if (wheel_path_.empty()) throw ConfigError({config_.motors.string(), 0, 0}, "the log holds no line of the motors");
  read_lines(config_.file, "S", &Reader::take_scan);
  scans_.finish();
  return std::move(scans_);
}

}  // namespace

void Config::describe(Fields<Config>& fields) {
  fields.file("file", &Config::file, "the scans (lines S), plain or gzip").required = true;
  fields.file("motors", &Config::motors, "the wheels' tick counts (lines M), plain or gzip").required = true;
  fields.group("wheels", &Config::wheels, "how far a tick goes, and how far apart the wheels are");
  fields.group("laser", &Config::laser, "the laser, of which the log says nothing");
  fields.number("range_ratio", &Config::range_ratio, {0.5, 2.0}, "",
                "every range is multiplied by this: metres of the map in a metre of the laser");
  fields.number("range_offset_m", &Config::range_offset_m, {-1.0, 1.0}, "m",
                "then added to every range: what the laser always measures too little");
  LogRules::describe_rules(fields);
}

ScanLog read_lego_log(const Config& config, double start_heading_rad, const Budget& budget) {
  return Reader(config, start_heading_rad, budget).read();
}

}  // namespace cairn::lego_log
