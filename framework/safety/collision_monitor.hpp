// The collision monitor: below every behaviour, the only one that orders the drive, and it never lets the robot drive
// into what its sensors see (VelocityLimiter). Nothing in a mission takes it away.
//
// A command holds for command_valid_s only. The robot stands while the host does something that may take long, and is
// ordered on at the end of the tick; another thread watches that ticks end.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "framework/contracts/optional/stop_report.hpp"
#include "framework/contracts/sensor.hpp"
#include "framework/modules/staged.hpp"
#include "framework/safety/velocity_limiter.hpp"

namespace cairn {

// What has become of the wanted velocity of a tick.
struct DriveCommand {
  Twist commanded{};
  double speed_reduction_ratio = 0.0;  // share of the wanted speed that was left out: 0 none, 1 all
};

class CollisionMonitor {
 public:
  CollisionMonitor(const CollisionMonitorConfig& config, const RobotModel& robot,
                   std::shared_ptr<const WallClock> wall_clock = std::make_shared<SteadyClock>());

  // Before the run. Without a drive (a log) nothing is ordered.
  void attach(Staged<Drive> drive);
  [[nodiscard]] bool has_drive() const { return static_cast<bool>(drive_); }

  // Once a tick: limits the wanted velocity by what this observation and those before have shown, and orders it.
  // expected: what its readings should have heard, where somebody knows; it only ever slows the robot.
  // Throws ModuleFault.
  DriveCommand drive(const Observation& observation, const Twist& wanted, std::span<const ExpectedEcho> expected = {});
  // The robot brakes as when it is commanded to, and stands until the next drive(): before the host does something that
  // may take long. That is no stall. Throws ModuleFault.
  void stand();
  // It stops at once, because something has failed, until the next drive(). Throws ModuleFault.
  void stop();

  // From one other thread, every few milliseconds: stops the wheels as long as no tick has ended for stop_after_s.
  // before_first_stop: called once for each such time, before what a stop may wake goes on.
  void stop_if_stalled(const std::function<void()>& before_first_stop);
  // How long no tick had ended when the last drive() let the wheels go on; none: not for long, or they stood already.
  [[nodiscard]] std::optional<double> stalled_s() const { return stalled_s_; }
  // Whether the thread that watches was held up then as well: the whole process was stopped, or had no processor.
  [[nodiscard]] bool was_watch_held_up() const { return was_watch_held_up_; }
  // From any thread, and from a signal handler.
  void stop_at_once() noexcept;
  // The same, and no drive() lets them turn again: the process is ending.
  void stop_for_good() noexcept;
  // Of these two, from a signal handler too: whether the drive has sent the stop to the wheels.
  [[nodiscard]] bool is_stop_sent() const noexcept;

  [[nodiscard]] const CollisionMonitorFigures& figures() const { return limiter_.figures(); }
  // Which transducers are deaf, and what of that has changed with the last drive().
  [[nodiscard]] const DeafTransducers& hearing() const { return limiter_.hearing(); }

 private:
  [[nodiscard]] std::int64_t now_ns() const noexcept;
  // Of the thread that watches: notes when it looks, and for how long it could not.
  void note_look(std::int64_t now) noexcept;
  // Once a tick: for most of the time since the one before.
  [[nodiscard]] bool was_watch_held_up_until(std::int64_t now) noexcept;
  // at_once: the robot stops as hard as it can, and twist is none.
  void order(const Twist& twist, bool at_once);

  VelocityLimiter limiter_;
  const double command_valid_s_;
  const std::int64_t stop_after_ns_;
  const std::shared_ptr<const WallClock> wall_clock_;
  Staged<Drive> drive_;
  std::atomic<Drive*> wheels_{nullptr};                  // the same for other threads
  std::atomic<const StopReport*> stop_report_{nullptr};  // the same, if it reports
  std::atomic<bool> is_over_{false};
  // Held while the drive is ordered: a stop for a tick that has just ended does not undo its command.
  std::mutex ordering_;
  std::atomic<std::int64_t> ordering_since_ns_{0};  // 0: not under way
  std::atomic<std::int64_t> ordered_ns_{0};         // the last tick's end
  std::int64_t stopped_after_ns_ = 0;               // of the thread that watches: the tick's end that it stopped after
  std::atomic<std::int64_t> looked_ns_{0};          // when the thread that watches looked last; 0: there is none
  std::atomic<std::int64_t> held_up_ns_{0};         // it did not look, since the last tick
  bool is_standing_ = false;                        // since the last tick: on purpose
  std::optional<double> stalled_s_;
  bool was_watch_held_up_ = false;
};

}  // namespace cairn
