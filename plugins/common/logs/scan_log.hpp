// Recorded scans in memory, played back one observation after the other.
//
// Time. Stamps of logs lie: some stand still, some jump. The rule:
//   stamps that hardly change           when, of ten scans or more, fewer than one in ten has a stamp that
//                                       differs from the one before, none is used: scans are period_s apart
//   a stamp before the last one, or     a clock jump: bridged (the scan is period_s after the last one,
//   more than longest_gap_s after it    and time goes on from there) or refused
// so that the observations' stamps never go back. Both are counted and reported at the end of the log.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/ground_truth.hpp"
#include "framework/contracts/sensor.hpp"
#include "plugins/common/logs/log_line.hpp"

namespace cairn::log_common {

enum class BadLine { refuse, skip };
enum class ClockJump { bridge, refuse };
enum class NoEcho { silence, nothing };

// The settings that every log has.
struct LogRules {
  double period_s = 0.1;
  double longest_gap_s = 600.0;
  ClockJump on_clock_jump = ClockJump::bridge;
  BadLine on_bad_line = BadLine::refuse;
  bool compass_from_pose = false;
  std::vector<double> no_echo;
  NoEcho no_echo_means = NoEcho::silence;

  template <class Config>
  static void describe_rules(Fields<Config>& fields) {
    const auto number = [&fields](const char* key, double LogRules::*member, Range range, const char* meaning) {
      fields.number(key, static_cast<double Config::*>(member), range, "s", meaning);
    };
    number("period_s", &LogRules::period_s, {1e-6, 3600},
           "time between scans where the log's own time is unusable: its stamps stand still, or across a clock jump");
    number("longest_gap_s", &LogRules::longest_gap_s, {1e-3, 1e9},
           "a stamp that goes back, or more than this ahead, is a clock jump");
    fields.choice("on_clock_jump", static_cast<ClockJump Config::*>(&Config::on_clock_jump),
                  {{"bridge", ClockJump::bridge}, {"refuse", ClockJump::refuse}},
                  "time goes on period_s after the last scan, and the jump is counted; or an error");
    fields.choice("on_bad_line", static_cast<BadLine Config::*>(&Config::on_bad_line),
                  {{"refuse", BadLine::refuse}, {"skip", BadLine::skip}},
                  "a line that cannot be read: an error, or left out and counted");
    fields.flag("compass_from_pose", static_cast<bool Config::*>(&Config::compass_from_pose),
                "the pose's heading also serves as a compass");
    fields.numbers("no_echo", static_cast<std::vector<double> Config::*>(&Config::no_echo), {}, "",
                   "values, as they stand in the log, that mean no echo");
    fields.choice("no_echo_means", static_cast<NoEcho Config::*>(&Config::no_echo_means),
                  {{"silence", NoEcho::silence}, {"nothing", NoEcho::nothing}},
                  "what no echo says: the beam is free, or nothing (a laser's lost beams)");
  }
};

struct Scan {
  double stamp_s = 0.0;
  int line = 0;  // 0: the log has none
  Pose2 T_odom_robot;
  std::optional<double> compass_rad;
  bool bumped = false;
  std::optional<Pose2> true_T_map_robot;
};

// A line that is refused whatever the rule for bad lines.
class RefusedLine : public ConfigError {
 public:
  using ConfigError::ConfigError;
};

// What a recorded number means as a range of this reading: range_from() with these rules.
[[nodiscard]] double recorded_range(double value, const LogRules& rules, const RangeReading& reading);

class ScanLog {
 public:
  // budget: of the reading.
  ScanLog(std::string file_name, const LogRules& rules, const Budget& budget = {})
      : file_(std::move(file_name)), rules_(rules), budget_(budget) {}

  // Where the ranges of a scan were taken: readings without their ranges. The number serves in add().
  // A key that is known already gives its number; make is called for a new one only.
  template <class Make>
  std::size_t source(const std::string& key, Make make) {
    const auto known = sources_by_key_.find(key);
    if (known != sources_by_key_.end()) return known->second;
    sources_.push_back(make());  // may throw, and then there is no such key
    sources_by_key_.emplace(key, sources_.size() - 1);
    return sources_.size() - 1;
  }
  [[nodiscard]] const std::vector<RangeReading>& readings_of(std::size_t source) const { return sources_[source]; }

  void add(const Scan& scan, std::size_t source, std::span<const double> ranges_m);
  // The same with ranges as they stand in the log.
  void add_recorded(const Scan& scan, std::size_t source, std::vector<double> values);
  // Odometry as counted from the first pose of the log; sets compass and start, too.
  void set_pose(const Pose2& T_log_robot, Scan& scan);
  void set_start(const Pose2& T_map_start) { start_ = T_map_start; }
  // When all poses are set: the log's frame is not the map's.
  void forget_start() { start_.reset(); }
  // Other odometry than that of the scans, a pose a scan: where a log states it behind them. The start is its first
  // pose.
  void replace_odometry(std::span<const Pose2> T_odom_robot);

  // Takes every line of a file that is not blank, cut as LogLine::cut does; one at which take throws ConfigError is a
  // bad line. Returns the place of the last. Throws ReadingEnded when the budget is exhausted.
  SourcePlace read_lines(const std::filesystem::path& file, const std::function<void(const LogLine&)>& take,
                         std::optional<char> separator = {});
  // What a log is made of that has no lines.
  void count_in(std::string unit) { unit_ = std::move(unit); }
  // Refuses or counts, by the rule.
  void bad_line(const ConfigError& error);
  void unknown_line(std::string_view kind);
  void note(const std::string& sentence) { notes_.push_back(sentence); }

  // When all is read. Throws ConfigError for a log without a scan. Notes that all of several scans have the same pose.
  void require_scans();
  // The same, and decides on the stamps. Throws ConfigError also for a clock jump when those are refused.
  void finish();

  // When all is read.
  [[nodiscard]] std::size_t size() const { return scans_.size(); }
  [[nodiscard]] Observation observation(std::size_t i) const;
  [[nodiscard]] std::optional<GroundTruth> truth(std::size_t i) const;
  [[nodiscard]] const std::optional<Pose2>& start() const { return start_; }
  // "end of x.log after 3 observations; ..." with all that was counted.
  [[nodiscard]] std::string end_sentence() const;

 private:
  struct Kept : Scan {
    std::size_t source = 0;
    std::size_t first_range = 0;
    double recorded_s = 0.0;
  };
  void bridge_jumps();
  [[nodiscard]] std::string name_of_file() const;

  std::string file_;
  LogRules rules_;
  Budget budget_;
  std::map<std::string, std::size_t> sources_by_key_;
  std::vector<std::vector<RangeReading>> sources_;
  std::vector<Kept> scans_;
  std::vector<double> ranges_m_;
  std::optional<Pose2> start_;
  std::string unit_ = "line";
  int bad_lines_ = 0;
  std::string first_bad_;
  std::map<std::string, int, std::less<>> unknown_;
  int unknown_lines_ = 0;
  std::vector<std::string> notes_;
};

// A sensor that plays such a log.
class ScanPlayer : public Sensor, public GroundTruthSource {
 public:
  explicit ScanPlayer(ScanLog log) : log_(std::move(log)) {}

  SensorStep next(const Budget& budget) override;
  // The log's first pose in the log's frame, which is the map's; nothing without poses.
  [[nodiscard]] std::optional<Pose2> start() const override { return log_.start(); }
  [[nodiscard]] const GroundTruthSource* truth() const override { return this; }
  [[nodiscard]] std::optional<GroundTruth> last_truth() const override {
    return next_ == 0 ? std::nullopt : log_.truth(next_ - 1);
  }

 private:
  ScanLog log_;
  std::size_t next_ = 0;
};

}  // namespace cairn::log_common
