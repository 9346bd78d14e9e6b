#include "framework/safety/collision_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cairn {
namespace {

// An order that has not returned for so long keeps nobody from stopping the wheels.
constexpr std::int64_t kLongOrder_ns = 50'000'000;

}  // namespace

CollisionMonitor::CollisionMonitor(const CollisionMonitorConfig& config, const RobotModel& robot,
                                   std::shared_ptr<const WallClock> wall_clock)
    : limiter_(config, robot),
      command_valid_s_(config.command_valid_s),
      stop_after_ns_(std::llround(1e9 * config.stop_after_s)),
      wall_clock_(std::move(wall_clock)) {}

std::int64_t CollisionMonitor::now_ns() const noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(wall_clock_->now().time_since_epoch()).count();
}

void CollisionMonitor::attach(Staged<Drive> drive) {
  drive_ = std::move(drive);
  ordered_ns_ = now_ns();
  Drive* const wheels = drive_ ? &drive_.unwatched() : nullptr;
  stop_report_ = dynamic_cast<const StopReport*>(wheels);
  wheels_ = wheels;
}

DriveCommand CollisionMonitor::drive(const Observation& observation, const Twist& wanted,
                                     std::span<const ExpectedEcho> expected) {
  if (!drive_) return {};
  limiter_.see(observation, expected);
  const Twist allowed = limiter_.limit(wanted);
  order(allowed, limiter_.is_blind_for_long());
  return {allowed, limiter_.speed_reduction_ratio(wanted, allowed)};
}

void CollisionMonitor::order(const Twist& twist, bool at_once) {
  const std::scoped_lock lock(ordering_);
  ordering_since_ns_ = now_ns();
  struct End {
    std::atomic<std::int64_t>& since;
    ~End() { since = 0; }
  } const end{ordering_since_ns_};
  drive_.call([&](Drive& drive) {
    if (!at_once && !is_over_) drive.command(twist, command_valid_s_);
    if (at_once || is_over_) drive.stop();  // is_over_: also when that came after the command
  });
  const std::int64_t now = now_ns();
  was_watch_held_up_ = was_watch_held_up_until(now);
  const bool was_standing = std::exchange(is_standing_, false);
  // By the time alone, whoever has stopped the wheels: when the whole process stood, the drive's own time has.
  const bool was_stalled = now - ordered_ns_ >= stop_after_ns_;
  stalled_s_ =
      was_stalled && !was_standing ? std::optional(1e-9 * static_cast<double>(now - ordered_ns_)) : std::nullopt;
  ordered_ns_ = now;
}

void CollisionMonitor::stand() {
  if (!drive_) return;
  drive_.call([&](Drive& drive) { drive.command(Twist{}, command_valid_s_); });
  is_standing_ = true;
}

void CollisionMonitor::stop() {
  if (drive_) drive_.call([](Drive& drive) { drive.stop(); });
}

void CollisionMonitor::note_look(std::int64_t now) noexcept {
  const std::int64_t before = looked_ns_.exchange(now);
  if (before != 0 && now - before > stop_after_ns_ / 2) held_up_ns_ += now - before;
}

bool CollisionMonitor::was_watch_held_up_until(std::int64_t now) noexcept {
  const std::int64_t looked = looked_ns_;
  const std::int64_t not_yet_noted = looked == 0 ? 0 : std::max<std::int64_t>(now - looked, 0);
  return 2 * (held_up_ns_.exchange(0) + not_yet_noted) > now - ordered_ns_;
}

void CollisionMonitor::stop_if_stalled(const std::function<void()>& before_first_stop) {
  Drive* const wheels = wheels_;
  const std::int64_t after_ns = ordered_ns_;
  const std::int64_t now = now_ns();
  note_look(now);
  if (wheels == nullptr || now - after_ns < stop_after_ns_) return;
  std::unique_lock lock(ordering_, std::defer_lock);
  if (!lock.try_lock()) {
    const std::int64_t since_ns = ordering_since_ns_;
    if (since_ns == 0 || now_ns() - since_ns < kLongOrder_ns) return;  // the tick is just ending
  }
  if (ordered_ns_ != after_ns) return;  // it has ended
  if (std::exchange(stopped_after_ns_, after_ns) != after_ns) before_first_stop();
  wheels->stop();
}

void CollisionMonitor::stop_at_once() noexcept {
  if (Drive* const wheels = wheels_) wheels->stop();
}

void CollisionMonitor::stop_for_good() noexcept {
  is_over_ = true;
  stop_at_once();
}

bool CollisionMonitor::is_stop_sent() const noexcept {
  const StopReport* const report = stop_report_;
  return report == nullptr || report->is_stop_sent();
}

}  // namespace cairn
