#include "plugins/player_log/player_log.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "plugins/common/logs/log_line.hpp"

namespace cairn::player_log {
namespace {

using log_common::LogLine;
using log_common::RefusedLine;
using log_common::ScanLog;

constexpr std::array<std::string_view, 2> kRangeInterfaces = {"sonar", "laser"};
constexpr std::size_t kPayload = 7;
constexpr std::string_view kVersionMark = "File version:";
constexpr std::string_view kVersion = "0.3.";

// What a line is about.
struct Header {
  std::string_view interface;
  int index = 0;
  std::size_t type = 0;
  std::size_t subtype = 0;

  [[nodiscard]] bool is(std::string_view name, int at, std::size_t a_type, std::size_t a_subtype) const {
    return interface == name && index == at && type == a_type && subtype == a_subtype;
  }
};

class Reader {
 public:
  Reader(const Config& config, const RobotModel& robot, const Budget& budget);
  ScanLog read();

 private:
  void read_line(const LogLine& line);
  void read_sonar_geometry(const LogLine& line);
  void read_sonar_ranges(const LogLine& line);
  void read_laser_scan(const LogLine& line, std::size_t at);
  void read_ranger(const LogLine& line, const Header& header);
  void add_fan(const LogLine& line, log_common::Fan fan, double max_m, std::size_t count, std::size_t first_range,
               std::size_t words_a_range);
  void add_scan(const LogLine& line, std::size_t source, std::vector<double> ranges);
  [[nodiscard]] bool wants(std::string_view interface) const;

  const Config& config_;
  ScanLog scans_;
  std::vector<Pose2> robot_sonars_;
  std::vector<Pose2> T_robot_sonars_;  // as the log says
  std::optional<Pose2> T_robot_laser_;
  struct Ranger {
    double first_angle_rad = 0.0;
    double step_rad = 0.0;
    double max_m = 0.0;
  };
  std::optional<Ranger> ranger_;
  std::optional<Pose2> T_log_robot_;
  int next_sensor_ = 0;  // transducers are numbered in the order of their sources
};

// The words behind the count must be `each` for each of them.
std::size_t counted_words(const LogLine& line, std::size_t at, std::size_t each, std::string_view what) {
  const std::size_t count = line.count(at, "count of " + std::string(what));
  const std::size_t follow = line.size() - at - 1;
  if (follow != each * count)
    throw ConfigError(line.place(at), std::to_string(count) + " " + std::string(what) + ", says the line, but " +
                                          std::to_string(follow) + " words follow, not " +
                                          std::to_string(each * count));
  return count;
}

void check_version(const LogLine& line) {
  const std::string_view comment = line.text();
  const std::size_t mark = comment.find(kVersionMark);
  if (mark == std::string_view::npos) return;
  const std::size_t begin = comment.find_first_not_of(' ', mark + kVersionMark.size());
  const std::string_view version = comment.substr(std::min(begin, comment.size()));
  if (!version.starts_with(kVersion))
    throw RefusedLine(line.place(0), "a Player log of file version " + in_quotes(version) + "; 0.3.0 can be read");
}

Reader::Reader(const Config& config, const RobotModel& robot, const Budget& budget)
    : config_(config), scans_(config.file.string(), config, budget) {
  const SourcePlace place{config.file.string(), 0, 0};
  for (const std::string& name : config.interfaces)
    if (std::find(kRangeInterfaces.begin(), kRangeInterfaces.end(), name) == kRangeInterfaces.end())
      throw ConfigError(place, "interfaces: no ranges are read from " + in_quotes(name) +
                                   did_you_mean(name, {kRangeInterfaces.begin(), kRangeInterfaces.end()}));
  log_common::check_limits(config.file, "sonar", config.sonar.min_m, config.sonar.max_m);
  log_common::check_limits(config.file, "laser", config.laser);
  for (const SonarModel& sonar : robot.sonars) robot_sonars_.push_back(sonar.T_robot_sonar);
}

ScanLog Reader::read() {
  static_cast<void>(scans_.read_lines(config_.file, [this](const LogLine& line) { read_line(line); }));
  scans_.finish();
  return std::move(scans_);
}

bool Reader::wants(std::string_view interface) const {
  const auto& names = config_.interfaces;
  return names.empty() || std::find(names.begin(), names.end(), interface) != names.end();
}

void Reader::read_line(const LogLine& line) {
  if (line.word(0).starts_with('#')) return check_version(line);
  if (line.size() < kPayload)
    throw ConfigError(line.place(line.size()),
                      "the line ends before its payload: time host robot interface index type subtype payload");
  const Header header{line.word(3), static_cast<int>(line.count(4, "index")), line.count(5, "type"),
                      line.count(6, "subtype")};
  if (header.is("position2d", config_.position_index, 1, 1)) {
    T_log_robot_ = line.pose(kPayload);
  } else if (header.is("sonar", config_.sonar_index, 1, 2) || header.is("sonar", config_.sonar_index, 4, 1)) {
    read_sonar_geometry(line);
  } else if (header.is("sonar", config_.sonar_index, 1, 1)) {
    if (wants(header.interface)) read_sonar_ranges(line);
  } else if (header.is("laser", config_.laser_index, 4, 1)) {
    T_robot_laser_ = line.pose(kPayload);
  } else if (header.is("laser", config_.laser_index, 1, 1)) {
    if (wants(header.interface)) read_laser_scan(line, kPayload + 1);
  } else if (header.is("laser", config_.laser_index, 1, 2)) {
    if (wants(header.interface)) read_laser_scan(line, kPayload + 4);
  } else if (header.interface == "ranger" && header.index == config_.laser_index) {
    read_ranger(line, header);
  } else {
    scans_.unknown_line(std::string(header.interface) + ":" + std::to_string(header.type) + ":" +
                        std::to_string(header.subtype));
  }
}

// count x0 y0 a0 x1 y1 a1 ...
void Reader::read_sonar_geometry(const LogLine& line) {
  const std::size_t count = counted_words(line, kPayload, 3, "sonars");
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < count; ++i) poses.push_back(line.pose(kPayload + 1 + 3 * i));
  T_robot_sonars_ = std::move(poses);
}

// count r0 r1 ...
void Reader::read_sonar_ranges(const LogLine& line) {
  const std::size_t count = counted_words(line, kPayload, 1, "ranges");
  const std::vector<Pose2>& poses = T_robot_sonars_.empty() ? robot_sonars_ : T_robot_sonars_;
  if (poses.size() != count)
    throw ConfigError(line.place(kPayload),
                      std::to_string(count) + " ranges, but " +
                          (T_robot_sonars_.empty() ? "no sonar geometry so far, and the robot file has "
                                                   : "the sonar geometry before has ") +
                          std::to_string(poses.size()) + " sonars");
  std::string key = "sonar";
  for (const Pose2& pose : poses)
    for (const double value : {pose.x_m, pose.y_m, pose.theta_rad}) key += " " + config_detail::number_text(value);
  const std::size_t source = scans_.source(key, [&] {
    std::vector<RangeReading> readings;
    readings.reserve(poses.size());
    const SonarConfig& sonar = config_.sonar;
    for (const Pose2& pose : poses)
      readings.push_back({pose, sonar.half_beam_rad, sonar.min_m, sonar.max_m, 0.0, next_sensor_++});
    return readings;
  });
  add_scan(line, source, line.ranges_m(kPayload + 1, count));
}

// id [x y theta] min_angle max_angle resolution max_range count (range intensity)...
void Reader::read_laser_scan(const LogLine& line, std::size_t at) {
  log_common::Fan fan;
  fan.first_angle_rad = line.metres(at, "smallest angle");
  fan.step_rad = line.metres(at + 2, "resolution");
  const double max_m = line.metres(at + 3, "maximum range");
  const std::size_t count = counted_words(line, at + 4, 2, "ranges with intensities");
  add_fan(line, fan, max_m, count, at + 5, 2);
}

void Reader::add_fan(const LogLine& line, log_common::Fan fan, double max_m, std::size_t count, std::size_t first_range,
                     std::size_t words_a_range) {
  fan.max_m = config_.laser.max_m.value_or(max_m > config_.laser.min_m ? max_m : log_common::kUsualLaserMax_m);
  fan.T_robot_laser = config_.laser.placed(T_robot_laser_.value_or(Pose2{}));
  const std::size_t source = scans_.source("laser " + log_common::key_of(fan, count), [&] {
    const int first = next_sensor_;
    next_sensor_ += static_cast<int>(count);
    return log_common::readings_of(fan, count, config_.laser, first);
  });
  add_scan(line, source, line.ranges_m(first_range, count, words_a_range));
}

// Geometry: x y z roll pitch yaw ...; configuration: min_angle max_angle resolution min_range max_range ...; ranges:
// count r0 r1 ... A few of them are no laser's.
void Reader::read_ranger(const LogLine& line, const Header& header) {
  constexpr std::size_t kFewestOfALaser = 30;
  const bool has_ranges = header.type == 1 && header.subtype <= 2;
  const std::size_t count = has_ranges ? line.count(kPayload, "count of ranges") : 0;
  if (header.type == 4 && header.subtype == 1) {
    T_robot_laser_ = Pose2{line.metres(kPayload, "x"), line.metres(kPayload + 1, "y"), line.heading(kPayload + 5)};
  } else if (header.type == 4 && header.subtype == 5) {
    ranger_ = Ranger{line.metres(kPayload, "smallest angle"), line.metres(kPayload + 2, "resolution"),
                     line.metres(kPayload + 4, "maximum range")};
  } else if (count < kFewestOfALaser) {
    scans_.unknown_line("ranger:" + std::to_string(header.type) + ":" + std::to_string(header.subtype));
  } else if (wants("laser")) {
    log_common::Fan fan = log_common::usual_fan(config_.laser, count);
    if (ranger_ && ranger_->step_rad > 0.0) {
      fan.first_angle_rad = ranger_->first_angle_rad;
      fan.step_rad = ranger_->step_rad;
    }
    add_fan(line, fan, ranger_ ? ranger_->max_m : 0.0, count, kPayload + 1, 1);
  }
}

// Before any pose the robot is taken to be where the first one says.
void Reader::add_scan(const LogLine& line, std::size_t source, std::vector<double> ranges) {
  log_common::Scan scan;
  scan.stamp_s = line.finite(0, "time");
  scan.line = line.line();
  if (T_log_robot_) scans_.set_pose(*T_log_robot_, scan);
  scans_.add_recorded(scan, source, std::move(ranges));
}

}  // namespace

void SonarConfig::describe(Fields<SonarConfig>& fields) {
  fields.angle("half_beam_deg", &SonarConfig::half_beam_rad, {0, 90}, "half the width of the beam");
  fields.number("min_m", &SonarConfig::min_m, {0, 100}, "m", "shortest range");
  fields.number("max_m", &SonarConfig::max_m, {0.01, 1000}, "m", "longest range, what is beyond is no echo");
}

void Config::describe(Fields<Config>& fields) {
  fields.file("file", &Config::file, "the log, plain or gzip").required = true;
  fields.texts("interfaces", &Config::interfaces, "whose ranges are read, of sonar and laser; left out: both");
  fields.integer("position_index", &Config::position_index, {0, 1000000}, "which position2d device gives the odometry");
  fields.integer("sonar_index", &Config::sonar_index, {0, 1000000}, "which sonar device is read");
  fields.integer("laser_index", &Config::laser_index, {0, 1000000}, "which laser device is read");
  fields.group("sonar", &Config::sonar, "what a Player log does not say about the sonars");
  fields.group("laser", &Config::laser, "what wins over what the log says about the laser");
  LogRules::describe_rules(fields);
}

ScanLog read_player_log(const Config& config, const RobotModel& robot, const Budget& budget) {
  return Reader(config, robot, budget).read();
}

}  // namespace cairn::player_log
