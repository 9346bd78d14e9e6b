#include "framework/program/doctor/live_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/contracts/optional/command_silence.hpp"
#include "framework/live/steady_time.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

constexpr double kStandsWithin_m = 0.01;
constexpr double kStandsWithin_rad = radians(2.0);
constexpr double kMaxClockError = 0.05;  // of the time that has passed
constexpr double kWiggle_m = 0.05;
constexpr double kWiggle_rad = radians(10.0);
constexpr double kWiggle_mps = 0.1;
constexpr double kWiggle_radps = radians(20.0);
constexpr double kCommandValid_s = 0.25;
constexpr double kMustStandWithin_s = 1.0;
constexpr double kSilence_s = 3.0;  // P2OS waits for two
constexpr double kSilentTurn_radps = radians(10.0);
constexpr double kTurnedOn_rad = radians(0.5);
constexpr double kMovesWithin_s = 0.3;  // odometry comes at its own pace

Finding good(std::string what, std::string text) {
  return {true, std::move(what), std::move(text), {}};
}
Finding bad(std::string what, std::string text) {
  return {false, std::move(what), std::move(text), {}};
}

// The next one; none: its fault is in why.
std::optional<Observation> next_of(Sensor& sensor, const std::atomic<bool>& end, std::string& why) {
  Budget budget;
  budget.cancel = &end;
  SensorStep step = sensor.next(budget);
  if (step.state == SensorState::observation) return std::move(step.observation);
  why = step.state == SensorState::fault ? step.reason : "it has come to its end, as a log does";
  return std::nullopt;
}

}  // namespace

std::vector<Finding> findings_of(const std::vector<ConnectionPart>& parts) {
  std::vector<Finding> all;
  for (const ConnectionPart& part : parts) {
    std::vector<std::string> texts;
    for (const ConnectionValue& value : part.values) texts.push_back(value.name + " " + value.text);
    const std::string values = joined(texts, "; ");
    const bool is_good = part.problem.empty();
    all.push_back({is_good, part.name, is_good ? values : fmt::format("{} ({})", part.problem, values), part.values});
  }
  return all;
}

void LiveCheck::watch(Sensor& sensor, double for_s, const std::atomic<bool>& end) {
  // Connecting is not counted.
  if (const auto first = next_of(sensor, end, fault_)) seen_.push_back({live::now_s(), *first});
  const double began_s = live::now_s();
  while (fault_.empty() && !end && live::now_s() - began_s < for_s)
    if (auto observation = next_of(sensor, end, fault_)) seen_.push_back({live::now_s(), std::move(*observation)});
}

std::vector<Finding> LiveCheck::findings(bool can_drive) const {
  if (seen_.empty()) return {bad("connection", fault_)};
  std::vector<Finding> all;
  all.push_back(fault_.empty() ? good("connection", "there") : bad("connection", fault_));
  all.push_back(can_drive ? good("wheels", "can be driven; nothing was commanded")
                          : bad("wheels", "cannot be driven: this source is a log"));
  if (seen_.size() < 2) return all;
  for (const Finding& finding :
       {pace(), clock(), odometry(), transducers(), echoes(), readings(), compass(), battery(), bumper()})
    all.push_back(finding);
  return all;
}

Finding LiveCheck::pace() const {
  double longest_s = 0.0;
  for (std::size_t i = 1; i < seen_.size(); ++i)
    longest_s = std::max(longest_s, seen_[i].arrived_s - seen_[i - 1].arrived_s);
  const double hz = static_cast<double>(seen_.size() - 1) / (seen_.back().arrived_s - seen_.front().arrived_s);
  const std::string text = fmt::format("{:.1f} a second, longest gap {:.2f} s", hz, longest_s);
  if (longest_s < stop_after_s_) return good("observations", text);
  return bad(
      "observations",
      text + fmt::format(
                 "; the wheels are stopped after {:g} s without one: set collision_monitor: {{stop_after_s: {:.1f}}}",
                 stop_after_s_, std::ceil(20.0 * longest_s) / 10.0));
}

Finding LiveCheck::clock() const {
  const double passed_s = seen_.back().arrived_s - seen_.front().arrived_s;
  const double stamped_s = seen_.back().observation.stamp_s - seen_.front().observation.stamp_s;
  const std::string text = fmt::format("its stamps went on by {:.2f} s in {:.2f} s", stamped_s, passed_s);
  if (std::abs(stamped_s - passed_s) < kMaxClockError * passed_s + 0.1) return good("clock", text);
  return bad("clock", text + ": is it simulated, paced, or set meanwhile?");
}

Finding LiveCheck::odometry() const {
  const Pose2 moved = inverse(seen_.front().observation.T_odom_robot) * seen_.back().observation.T_odom_robot;
  const std::string text =
      fmt::format("moved by {:.3f} m and {:.1f} deg", moved.position().norm(), degrees(moved.theta_rad));
  if (moved.position().norm() < kStandsWithin_m && std::abs(moved.theta_rad) < kStandsWithin_rad)
    return good("odometry", text + ": it stands");
  return bad("odometry", text + ": is somebody else driving it?");
}

Finding LiveCheck::transducers() const {
  const int expected = first_beam_of(robot_, robot_.lasers.size());
  std::map<int, int> heard;
  for (const Seen& seen : seen_)
    for (const RangeReading& reading : seen.observation.ranges) ++heard[reading.sensor];
  std::string silent;
  for (int i = 0; i < std::min(expected, static_cast<int>(robot_.sonars.size())); ++i)
    if (!heard.contains(i)) silent += " " + std::to_string(i);
  const std::string text = fmt::format("{} of {} were read", heard.size(), counted(expected, "transducer"));
  if (static_cast<int>(heard.size()) >= expected) return good("transducers", text);
  return bad("transducers", text + (silent.empty() ? "" : "; never:" + silent));
}

Finding LiveCheck::echoes() const {
  int with_echo = 0;
  int without = 0;
  int broken = 0;
  for (const Seen& seen : seen_)
    for (const RangeReading& reading : seen.observation.ranges)
      ++(std::isnan(reading.range_m) ? broken : std::isinf(reading.range_m) ? without : with_echo);
  const int all = with_echo + without + broken;
  const std::string text = fmt::format("{} of {} readings have an echo, {} are broken", with_echo, all, broken);
  if (with_echo == 0) return bad("echoes", text + ": is anything within reach of its sensors?");
  return broken > all / 10 ? bad("echoes", text) : good("echoes", text);
}

Finding LiveCheck::readings() const {
  if (std::ranges::all_of(seen_, [](const Seen& seen) { return seen.observation.ranges.empty(); }))
    return bad("readings", "none has come: is what publishes or sends them there?");
  double last_s = seen_.front().arrived_s;
  double longest_s = 0.0;
  for (const Seen& seen : seen_) {
    if (seen.observation.ranges.empty()) continue;
    longest_s = std::max(longest_s, seen.arrived_s - last_s);
    last_s = seen.arrived_s;
  }
  longest_s = std::max(longest_s, seen_.back().arrived_s - last_s);
  const std::string text = fmt::format("longest time without one {:.2f} s", longest_s);
  if (longest_s <= blind_s_) return good("readings", text);
  return bad("readings",
             text + fmt::format("; after {:.2f} s the robot is stopped: set collision_monitor: {{blind_s: {:.1f}}}",
                                blind_s_, std::ceil(20.0 * longest_s) / 10.0));
}

Finding LiveCheck::compass() const {
  std::optional<double> first;
  double spread_rad = 0.0;
  for (const Seen& seen : seen_) {
    if (!seen.observation.compass_rad) continue;
    if (!first) first = seen.observation.compass_rad;
    spread_rad = std::max(spread_rad, std::abs(wrap_angle(*seen.observation.compass_rad - *first)));
  }
  if (!first)
    return robot_.has_compass
               ? bad("compass", "the robot's file has one, and it says nothing; take `compass:` out of the file")
               : good("compass", "none, and none in the robot's file");
  return good("compass", fmt::format("{:.0f} deg, within {:.1f} deg", degrees(*first), degrees(spread_rad)));
}

Finding LiveCheck::battery() const {
  const std::optional<double> ratio = seen_.back().observation.battery_ratio;
  if (!ratio) return good("battery", "not known");
  const std::string text = fmt::format("{:.0f} %", 100.0 * *ratio);
  return *ratio < 0.1 ? bad("battery", text) : good("battery", text);
}

Finding LiveCheck::bumper() const {
  const bool is_bumped = std::ranges::any_of(seen_, [](const Seen& seen) { return seen.observation.bumped; });
  return is_bumped ? bad("bumper", "something is touched, or a motor is stalled") : good("bumper", "free");
}

namespace {

// Drives until it has moved so far by its odometry, or the time is over; by how much it has.
class Wiggle {
 public:
  Wiggle(Sensor& sensor, const std::atomic<bool>& end) : sensor_(sensor), end_(end) {}

  std::vector<Finding> findings() {
    turn_and_drive("ahead", {kWiggle_mps, 0.0}, kWiggle_m);
    turn_and_drive("back", {-kWiggle_mps, 0.0}, -kWiggle_m);
    turn_and_drive("left", {0.0, kWiggle_radps}, kWiggle_rad);
    turn_and_drive("right", {0.0, -kWiggle_radps}, -kWiggle_rad);
    stops_by_itself();
    settle();
    stops_in_silence();
    sensor_.drive()->stop();
    return std::move(findings_);
  }

 private:
  [[nodiscard]] bool is_over() const { return !fault_.empty() || end_; }

  void turn_and_drive(const char* way, const Twist& twist, double wanted) {
    if (is_over()) return;
    const bool is_turn = twist.w_radps != 0.0;
    const auto from = next_of(sensor_, end_, fault_);
    double moved = 0.0;
    const double until_s = live::now_s() + 3.0 * std::abs(wanted / (is_turn ? twist.w_radps : twist.v_mps)) + 0.5;
    while (!is_over() && std::abs(moved) < std::abs(wanted) && live::now_s() < until_s) {
      sensor_.drive()->command(twist, kCommandValid_s);
      const auto now = next_of(sensor_, end_, fault_);
      if (!now) break;
      const Pose2 step = inverse(from->T_odom_robot) * now->T_odom_robot;
      moved = is_turn ? step.theta_rad : step.x_m;
    }
    sensor_.drive()->stop();
    const std::string text =
        is_turn ? fmt::format("{:+.1f} deg by the odometry, {:+.0f} were wanted", degrees(moved), degrees(wanted))
                : fmt::format("{:+.3f} m by the odometry, {:+.2f} were wanted", moved, wanted);
    if (!fault_.empty())
      findings_.push_back(bad(way, fault_));
    else if (moved * wanted < 0.0)
      findings_.push_back(bad(way, text + ": a sign is wrong"));
    else if (std::abs(moved) < 0.5 * std::abs(wanted))
      findings_.push_back(bad(way, text + ": are the motors on, and does nothing hold it?"));
    else
      findings_.push_back(good(way, text));
    settle();
  }

  // A velocity that counts for a quarter of a second, and then nothing.
  void stops_by_itself() {
    if (is_over()) return;
    sensor_.drive()->command({kWiggle_mps, 0.0}, kCommandValid_s);
    const double ordered_s = live::now_s();
    double moved_s = ordered_s;
    std::optional<Observation> last = next_of(sensor_, end_, fault_);
    while (!is_over() && live::now_s() - ordered_s < 2.0 * kMustStandWithin_s) {
      const auto now = next_of(sensor_, end_, fault_);
      if (!now) break;
      if ((now->T_odom_robot.position() - last->T_odom_robot.position()).norm() > 0.001) moved_s = live::now_s();
      last = now;
    }
    const std::string text =
        fmt::format("stood {:.2f} s after a command that counts for {:g} s", moved_s - ordered_s, kCommandValid_s);
    findings_.push_back(moved_s - ordered_s < kMustStandWithin_s ? good("stops by itself", text)
                                                                 : bad("stops by itself", text));
  }

  // It turns, and then nothing is sent at all, as when the cable is pulled: only the base itself can stop the wheels.
  void stops_in_silence() {
    auto* const silence = dynamic_cast<CommandSilence*>(sensor_.drive());
    if (silence == nullptr || is_over()) return;
    std::optional<Observation> moved;
    for (const double until_s = live::now_s() + 1.0; !is_over() && live::now_s() < until_s;) {
      sensor_.drive()->command({0.0, kSilentTurn_radps}, kCommandValid_s);
      moved = next_of(sensor_, end_, fault_);
    }
    silence->be_silent(kSilence_s);
    const double silent_s = live::now_s();
    double moved_s = silent_s;
    while (!is_over() && moved && live::now_s() - silent_s < kSilence_s) {
      const auto now = next_of(sensor_, end_, fault_);
      if (!now || std::abs(wrap_angle(now->T_odom_robot.theta_rad - moved->T_odom_robot.theta_rad)) < kTurnedOn_rad)
        continue;
      moved = now;
      moved_s = live::now_s();
    }
    sensor_.drive()->stop();
    const double turned_s = moved_s - silent_s;
    if (is_over()) return;
    findings_.push_back(
        turned_s < kSilence_s - kMovesWithin_s
            ? good("stops in silence", fmt::format("the base itself stood {:.1f} s after the last message", turned_s))
            : bad("stops in silence",
                  fmt::format("the wheels turned for {:g} s after the last message: when the cable is pulled or the "
                              "network fails, nothing stops it; set the time-out of the base's driver",
                              kSilence_s)));
  }

  void settle() {
    for (const double until_s = live::now_s() + 0.5; !is_over() && live::now_s() < until_s;)
      (void)next_of(sensor_, end_, fault_);
  }

  Sensor& sensor_;
  const std::atomic<bool>& end_;
  std::string fault_;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> wiggled(Sensor& sensor, const std::atomic<bool>& end) {
  return Wiggle(sensor, end).findings();
}

}  // namespace cairn
