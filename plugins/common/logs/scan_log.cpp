#include "plugins/common/logs/scan_log.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "maps/base/text.hpp"
#include "plugins/common/logs/log_text.hpp"
#include "plugins/common/logs/range_rule.hpp"

namespace cairn::log_common {
namespace {

constexpr std::size_t kKindsNamed = 8;
constexpr std::size_t kLongestKind = 32;
constexpr std::size_t kFewestToJudge = 10;
constexpr double kMinChangingRatio = 0.1;

}  // namespace

double recorded_range(double value, const LogRules& rules, const RangeReading& reading) {
  const double range_m = range_from(value, 1.0, rules.no_echo, reading.min_m, reading.max_m);
  const bool is_lost = std::isinf(range_m) && range_m > 0.0 && rules.no_echo_means == NoEcho::nothing;
  return is_lost ? std::numeric_limits<double>::quiet_NaN() : range_m;
}

void ScanLog::add(const Scan& scan, std::size_t source, std::span<const double> ranges_m) {
  Kept kept;
  static_cast<Scan&>(kept) = scan;
  kept.source = source;
  kept.first_range = ranges_m_.size();
  kept.recorded_s = scan.stamp_s;
  ranges_m_.insert(ranges_m_.end(), ranges_m.begin(), ranges_m.end());
  scans_.push_back(kept);
}

void ScanLog::add_recorded(const Scan& scan, std::size_t source, std::vector<double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = recorded_range(values[i], rules_, sources_[source][i]);
  add(scan, source, values);
}

SourcePlace ScanLog::read_lines(const std::filesystem::path& file, const std::function<void(const LogLine&)>& take,
                                std::optional<char> separator) {
  LogText text(file, budget_);
  LogLine line(text.name());
  std::string_view content;
  for (bool more = true; more;) {
    try {
      more = text.next(content);
      if (!more) break;
      line.cut(content, text.line_number(), separator);
      if (!trimmed(content).empty()) take(line);
    } catch (const RefusedLine&) {
      throw;
    } catch (const ReadingEnded&) {
      throw;
    } catch (const ConfigError& error) {
      bad_line(error);
    }
  }
  return {text.name(), text.line_number(), 1};
}

void ScanLog::set_pose(const Pose2& T_log_robot, Scan& scan) {
  if (!start_) start_ = T_log_robot;
  // The difference before the turn, so that the first pose is identity to the last bit.
  scan.T_odom_robot = Pose2{0.0, 0.0, -start_->theta_rad} *
                      Pose2{T_log_robot.x_m - start_->x_m, T_log_robot.y_m - start_->y_m, T_log_robot.theta_rad};
  if (rules_.compass_from_pose) scan.compass_rad = T_log_robot.theta_rad;
}

void ScanLog::replace_odometry(std::span<const Pose2> T_odom_robot) {
  start_.reset();
  for (std::size_t i = 0; i < scans_.size(); ++i) set_pose(T_odom_robot[i], scans_[i]);
}

std::string ScanLog::name_of_file() const {
  return std::filesystem::path(file_).filename().string();
}

void ScanLog::bad_line(const ConfigError& error) {
  if (rules_.on_bad_line == BadLine::refuse) throw error;
  if (bad_lines_++ > 0) return;
  first_bad_ = error.what();
  // The report must not depend on where the log lies.
  if (first_bad_.starts_with(file_)) first_bad_.replace(0, file_.size(), name_of_file());
}

void ScanLog::unknown_line(std::string_view kind) {
  ++unknown_lines_;
  kind = kind.substr(0, kLongestKind);
  const auto at = unknown_.find(kind);
  if (at != unknown_.end())
    ++at->second;
  else if (unknown_.size() < kKindsNamed)
    unknown_.emplace(kind, 1);
}

void ScanLog::require_scans() {
  if (scans_.empty())
    throw ConfigError({file_, 0, 0},
                      "the log holds no observation" +
                          (bad_lines_ > 0 ? "; first bad " + unit_ + ": " + first_bad_ : "") +
                          (unknown_lines_ > 0 ? "; " + counted(unknown_lines_, "line") + " of unknown kinds" : ""));
  const bool stands =
      std::ranges::all_of(scans_, [&](const Kept& scan) { return scan.T_odom_robot == scans_.front().T_odom_robot; });
  if (stands && scans_.size() >= kFewestToJudge)
    note(
        "all observations have the same pose: the log holds no poses, or the robot stood still; where it drove, "
        "`localizer: {plugin: scan_to_map}` estimates them from a laser's scans");
}

void ScanLog::finish() {
  require_scans();
  std::size_t changes = 0;
  for (std::size_t i = 1; i < scans_.size(); ++i)
    if (scans_[i].stamp_s != scans_[i - 1].stamp_s) ++changes;
  const bool unusable = scans_.size() >= kFewestToJudge &&
                        static_cast<double>(changes) < kMinChangingRatio * static_cast<double>(scans_.size());
  if (!unusable) {
    bridge_jumps();
    return;
  }
  for (std::size_t i = 0; i < scans_.size(); ++i) scans_[i].stamp_s = rules_.period_s * static_cast<double>(i);
  note("the time stamps stand still: scans taken as " + config_detail::number_text(rules_.period_s) + " s apart");
}

void ScanLog::bridge_jumps() {
  double ahead_s = 0.0;
  double last_stamp_s = scans_.front().stamp_s;
  int jumps = 0;
  std::string first;
  for (std::size_t i = 1; i < scans_.size(); ++i) {
    const double stamp_s = scans_[i].stamp_s;
    const double last_s = scans_[i - 1].stamp_s;
    const bool back = stamp_s < last_stamp_s;
    if (back || stamp_s - last_stamp_s > rules_.longest_gap_s) {
      if (rules_.on_clock_jump == ClockJump::refuse)
        throw ConfigError({file_, scans_[i].line, 1}, "the clock jumps from " +
                                                          config_detail::number_text(last_stamp_s) + " s to " +
                                                          config_detail::number_text(stamp_s) + " s");
      ahead_s = last_s + rules_.period_s - stamp_s;
      if (jumps++ == 0)
        first = scans_[i].line > 0 ? "line " + std::to_string(scans_[i].line) : "observation " + std::to_string(i + 1);
    }
    last_stamp_s = stamp_s;
    scans_[i].stamp_s = std::max(last_s, stamp_s + ahead_s);
  }
  if (jumps > 0) note(counted(jumps, "clock jump") + " bridged, the first at " + first);
}

Observation ScanLog::observation(std::size_t i) const {
  const Kept& scan = scans_[i];
  Observation seen;
  seen.stamp_s = scan.stamp_s;
  seen.recorded_s = scan.recorded_s;
  seen.T_odom_robot = scan.T_odom_robot;
  seen.compass_rad = scan.compass_rad;
  seen.bumped = scan.bumped;
  seen.ranges = sources_[scan.source];
  for (std::size_t k = 0; k < seen.ranges.size(); ++k) seen.ranges[k].range_m = ranges_m_[scan.first_range + k];
  return seen;
}

std::optional<GroundTruth> ScanLog::truth(std::size_t i) const {
  if (!scans_[i].true_T_map_robot) return std::nullopt;
  return GroundTruth{*scans_[i].true_T_map_robot};
}

std::string ScanLog::end_sentence() const {
  std::string text = "end of " + name_of_file() + " after " + std::to_string(scans_.size()) + " observations";
  if (bad_lines_ > 0) text += "; " + counted(bad_lines_, "bad " + unit_) + " skipped, the first: " + first_bad_;
  if (unknown_lines_ > 0) {
    text += "; " + counted(unknown_lines_, "line") + " of kinds not read:";
    for (const auto& [kind, count] : unknown_) text += " " + in_quotes(kind) + " " + std::to_string(count);
  }
  for (const std::string& note : notes_) text += "; " + note;
  return text;
}

SensorStep ScanPlayer::next(const Budget&) {
  SensorStep step;
  if (next_ < log_.size()) {
    step.state = SensorState::observation;
    step.observation = log_.observation(next_++);
    return step;
  }
  step.reason = log_.end_sentence();
  return step;
}

}  // namespace cairn::log_common
