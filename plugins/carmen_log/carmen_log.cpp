#include "plugins/carmen_log/carmen_log.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "maps/base/text.hpp"
#include "plugins/carmen_log/graph_steps.hpp"
#include "plugins/carmen_log/lasers.hpp"
#include "plugins/carmen_log/recording.hpp"

namespace cairn::carmen_log {
namespace {

using log_common::LogLine;
using log_common::ScanLog;

constexpr std::array<std::string_view, 5> kRangeKinds = {"FLASER", "RLASER", "ROBOTLASER1", "ROBOTLASER2", "SONAR"};

constexpr int kFewestToJudge = 10;  // lines
constexpr double kSame = 1e-5;      // metres and radians: logs write six digits

bool are_same(const Pose2& a, const Pose2& b) {
  return std::abs(a.x_m - b.x_m) <= kSame && std::abs(a.y_m - b.y_m) <= kSame &&
         std::abs(wrap_angle(a.theta_rad - b.theta_rad)) <= kSame;
}

class Reader {
 public:
  // reads_raw: also laser lines without poses.
  Reader(const Config& config, const Budget& budget, bool reads_raw);
  void read();
  [[nodiscard]] bool has_raw_scans_only() const { return raw_lines_ > 0 && scans_.size() == 0; }
  ScanLog finish();

 private:
  void read_line(const LogLine& line);
  [[nodiscard]] bool read_laser_line(const LogLine& line);
  void read_raw(const LogLine& line);
  void read_laser(const LogLine& line, const LaserLine& laser, bool rear);
  void read_sonar(const LogLine& line);
  void read_param(const LogLine& line);
  void add_scan(const LogLine& line, double stamp_s, const std::optional<Pose2>& T_log_robot, std::size_t source,
                std::size_t first_range, double unit_m = 1.0);
  [[nodiscard]] std::vector<RangeReading> sonars_of(const LogLine& line, std::size_t count);
  [[nodiscard]] bool wants(std::string_view kind) const;
  void compare(const Pose2& T_log_robot, const Pose2& T_odom_robot);
  void note_same_poses();
  void choose_odometry();

  const Config& config_;
  bool reads_raw_ = false;
  int raw_lines_ = 0;
  ScanLog scans_;
  Recording recording_;
  Params params_;
  GraphSteps steps_;
  std::optional<Pose2> T_log_robot_;  // of the last line that has one
  std::optional<Pose2> T_odom_line_;  // of the last ODOM line
  std::vector<Pose2> T_log_scan_;     // of the scans, and of the ODOM line before each
  std::vector<Pose2> T_odom_lines_;
  std::optional<Pose2> truth_;
  std::array<std::optional<Pose2>, 2> T_robot_said_;  // front and rear laser
  std::optional<Pose2> first_;                        // pose of a laser line
  int lines_with_both_ = 0;                           // poses: the log's and the odometry beside it
  bool have_differed_ = false;                        // these two
  bool has_moved_ = false;
  int next_sensor_ = 0;  // transducers are numbered in the order of their sources
};

void check(const Config& config) {
  const SourcePlace place{config.file.string(), 0, 0};
  for (const std::string& kind : config.lines)
    if (std::find(kRangeKinds.begin(), kRangeKinds.end(), kind) == kRangeKinds.end())
      throw ConfigError(place, "lines: there are no ranges in " + in_quotes(kind) +
                                   did_you_mean(kind, {kRangeKinds.begin(), kRangeKinds.end()}));
  log_common::check_limits(config.file, "laser", config.laser);
  log_common::check_limits(config.file, "rear_laser", config.rear_laser);
  log_common::check_limits(config.file, "sonar", config.sonar.min_m, config.sonar.max_m);
}

Reader::Reader(const Config& config, const Budget& budget, bool reads_raw)
    : config_(config), reads_raw_(reads_raw), scans_(config.file.string(), config, budget), recording_(scans_) {
  check(config);
}

void Reader::read() {
  recording_.check_complete(scans_.read_lines(config_.file, [this](const LogLine& line) { read_line(line); }));
}

ScanLog Reader::finish() {
  choose_odometry();
  scans_.finish();
  return std::move(scans_);
}

bool stands(const std::vector<Pose2>& poses) {
  return std::ranges::all_of(poses, [&](const Pose2& pose) { return are_same(pose, poses.front()); });
}

// The edges of a pose graph; or the ODOM lines where the laser lines' odometry stands still.
void Reader::choose_odometry() {
  if (config_.poses == Poses::odometry && steps_.has_steps() && T_log_scan_.size() == scans_.size()) {
    const GraphSteps::Chain chain = steps_.chained(T_log_scan_);
    scans_.replace_odometry(chain.T_first_scan);
    if (chain.missing > 0)
      scans_.note(counted(chain.missing, "step") + " between scans without an edge, taken from the laser lines");
    return;
  }
  note_same_poses();
  if (config_.poses != Poses::odometry || T_log_scan_.size() != scans_.size() || !stands(T_log_scan_) ||
      stands(T_odom_lines_))
    return;
  scans_.replace_odometry(T_odom_lines_);
  scans_.note("the odometry of the laser lines stands still: that of the ODOM lines taken");
}

bool Reader::wants(std::string_view kind) const {
  return config_.lines.empty() || std::find(config_.lines.begin(), config_.lines.end(), kind) != config_.lines.end();
}

void Reader::read_line(const LogLine& line) {
  const std::string_view kind = line.word(0);
  if (kind.starts_with('#') || kind == "SYNC") return;
  if (kind == "PARAM") return read_param(line);
  if (kind == "ODOM") {
    recording_.read_odometry(line);
    T_log_robot_ = T_odom_line_ = line.pose(1);
  } else if (kind == "TRUEPOS") {
    truth_ = Pose2{line.metres(1, "x"), line.metres(2, "y"), line.heading(3)};
    recording_.read_truth(*truth_);
  } else if (kind == "SONAR") {
    read_sonar(line);
  } else if (read_laser_line(line) || steps_.read(line)) {
    return;
  } else if (kind != "message" || line.line() != 1) {  // the logger's header, without its comment mark
    scans_.unknown_line(kind);
  }
}

bool Reader::read_laser_line(const LogLine& line) {
  const std::string_view kind = line.word(0);
  if (kind == "FLASER" || kind == "RLASER") {
    read_laser(line, read_flaser(line), kind == "RLASER");
  } else if (kind == "ROBOTLASER1" || kind == "ROBOTLASER2") {
    if (!recording_.take_scan(line)) read_laser(line, read_robotlaser(line), kind == "ROBOTLASER2");
  } else if (kind == "LASER_READING") {
    read_laser(line, read_laser_reading(line), false);
  } else if (kind == "L") {
    read_laser(line, read_l_line(line), false);
  } else if (kind == "O") {
    T_log_robot_ = T_odom_line_ = pose_in_cm(line, 1);
  } else if (kind == "RAWLASER1" || kind == "RAWLASER2") {
    ++raw_lines_;
    if (reads_raw_) read_raw(line);
  } else {
    return false;
  }
  return true;
}

// The robot is where the last ODOM line says.
void Reader::read_raw(const LogLine& line) {
  const bool rear = line.word(0) == "RAWLASER2";
  LaserLine laser = read_rawlaser(line);
  const log_common::LaserConfig& config = rear ? config_.rear_laser : config_.laser;
  const log_common::Fan fan = fan_of(laser, config.placed(said_place(laser, params_, rear)), config, params_, rear);
  laser.T_odom_robot = T_odom_line_.value_or(Pose2{});
  laser.T_log_laser = laser.T_odom_robot * fan.T_robot_laser;
  read_laser(line, laser, rear);
}

void Reader::read_param(const LogLine& line) {
  if (line.size() > 2 && line.word(1).starts_with("cairn_")) return recording_.read_param(line);
  constexpr std::string_view kPrefix = "robot_";  // the only ones that are asked for
  if (line.size() > 2 && line.word(1).starts_with(kPrefix))
    params_.insert_or_assign(std::string(line.word(1)), std::string(line.word(2)));
}

void Reader::read_laser(const LogLine& line, const LaserLine& laser, bool rear) {
  const log_common::LaserConfig& config = rear ? config_.rear_laser : config_.laser;
  // A laser does not move on its robot: the first line says where it sits, before the poses of a log that
  // is corrected in part have drifted apart.
  std::optional<Pose2>& said = T_robot_said_[rear ? 1 : 0];
  if (!said) said = said_place(laser, params_, rear);
  const log_common::Fan fan = fan_of(laser, config.placed(*said), config, params_, rear);
  const Pose2 T_log_robot = laser.T_log_laser * inverse(fan.T_robot_laser);
  T_log_robot_ = config_.poses == Poses::log ? T_log_robot : laser.T_odom_robot;
  if (!wants(line.word(0))) return;
  if (laser.has_both) compare(T_log_robot, laser.T_odom_robot);
  const std::string key = std::string(line.word(0)) + " " + log_common::key_of(fan, laser.ranges);
  const std::size_t source = scans_.source(key, [&] {
    const int first = next_sensor_;
    next_sensor_ += static_cast<int>(laser.ranges);
    return log_common::readings_of(fan, laser.ranges, config, first);
  });
  add_scan(line, laser.stamp_s, T_log_robot_, source, laser.first_range, laser.unit_m);
}

void Reader::compare(const Pose2& T_log_robot, const Pose2& T_odom_robot) {
  if (!first_) first_ = T_log_robot;
  ++lines_with_both_;
  have_differed_ = have_differed_ || !are_same(T_log_robot, T_odom_robot);
  has_moved_ = has_moved_ || !are_same(T_log_robot, *first_);
}

// Corrected logs often carry the corrected pose in the place of the odometry too.
void Reader::note_same_poses() {
  if (lines_with_both_ < kFewestToJudge || have_differed_ || !has_moved_) return;
  scans_.note("the odometry of all " + std::to_string(lines_with_both_) +
              " laser lines equals their pose: the log is not corrected, or its odometry was replaced by the corrected "
              "poses, on which no localizer can be tried");
}

// SONAR cone_angle n r1..rn (x y theta)xn time host time
void Reader::read_sonar(const LogLine& line) {
  constexpr std::size_t kFirstRange = 3;
  constexpr std::size_t kBehind = 3;
  const std::size_t count = line.count(2, "count of ranges");
  const std::size_t behind = kFirstRange + 4 * count;
  if (line.size() != behind + kBehind)
    throw ConfigError(line.place(2), std::to_string(count) + " sonars, says the line, but " +
                                         std::to_string(line.size() - kFirstRange) + " words follow, not " +
                                         std::to_string(4 * count + kBehind));
  if (recording_.take_sonar(line)) return;
  if (!wants("SONAR")) return;
  const double stamp_s = line.finite(behind, "time");
  std::string key = "SONAR " + std::string(line.word(1));
  for (std::size_t i = kFirstRange + count; i < behind; ++i) key.append(" ").append(line.word(i));
  const std::size_t source = scans_.source(key, [&] { return sonars_of(line, count); });
  add_scan(line, stamp_s, T_log_robot_, source, kFirstRange);
}

std::vector<RangeReading> Reader::sonars_of(const LogLine& line, std::size_t count) {
  const double cone_rad = line.finite(1, "cone angle");
  if (cone_rad < 0.0 || cone_rad > 2.0 * std::numbers::pi)
    throw ConfigError(line.place(1), "the cone angle must be from 0 to 2 pi radians");
  std::vector<RangeReading> sonars(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = 3 + count + 3 * i;
    RangeReading& sonar = sonars[i];
    sonar.T_robot_sensor = line.pose(at);
    sonar.half_beam_rad = config_.sonar.half_beam_rad.value_or(0.5 * cone_rad);
    sonar.min_m = config_.sonar.min_m;
    sonar.max_m = config_.sonar.max_m;
    sonar.sensor = next_sensor_ + static_cast<int>(i);
  }
  next_sensor_ += static_cast<int>(count);
  return sonars;
}

// Before any pose the robot is taken to be where the first one says.
void Reader::add_scan(const LogLine& line, double stamp_s, const std::optional<Pose2>& T_log_robot, std::size_t source,
                      std::size_t first_range, double unit_m) {
  std::vector<double> ranges = line.ranges_m(first_range, scans_.readings_of(source).size());
  for (double& range : ranges) range *= unit_m;
  log_common::Scan scan;
  scan.stamp_s = stamp_s;
  scan.line = line.line();
  scan.true_T_map_robot = truth_;
  if (T_log_robot) scans_.set_pose(*T_log_robot, scan);
  scans_.add_recorded(scan, source, std::move(ranges));
  steps_.add_scan();
  T_log_scan_.push_back(T_log_robot.value_or(scans_.start().value_or(Pose2{})));
  T_odom_lines_.push_back(T_odom_line_.value_or(Pose2{}));
}

}  // namespace

ScanLog read_carmen_log(const Config& config, const Budget& budget) {
  Reader reader(config, budget, false);
  reader.read();
  if (!reader.has_raw_scans_only()) return reader.finish();
  Reader raw(config, budget, true);
  raw.read();
  return raw.finish();
}

}  // namespace cairn::carmen_log
