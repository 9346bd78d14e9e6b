// What is ordered of the wheels: given by one thread, taken away by any, sent by another.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

#include "framework/contracts/robot_model.hpp"
#include "framework/live/command_timer.hpp"

namespace cairn::live {

// All times by one clock that does not step.
class VelocityOrders {
 public:
  // The twist is finite; it counts for valid_for_s.
  void order(const Twist& twist, double valid_for_s, double now_s) {
    const std::scoped_lock lock(lock_);
    number_.fetch_add(1);  // first, so that a stop() meanwhile is of this order too
    timer_.order(twist, valid_for_s, now_s);
  }
  // What was ordered up to now does not count any more. From a signal handler too.
  void stop() noexcept { stopped_.store(number_.load()); }
  [[nodiscard]] Twist ordered(double now_s) {
    const std::scoped_lock lock(lock_);
    return number_.load() > stopped_.load() ? timer_.ordered(now_s) : Twist{};
  }

 private:
  std::mutex lock_;
  CommandTimer timer_;
  std::atomic<std::uint64_t> number_{0};
  std::atomic<std::uint64_t> stopped_{0};
};

// From a velocity towards another within dt_s: it grows as fast as the robot's file allows, and falls at once. Never
// faster than the file allows.
[[nodiscard]] Twist approached(const Twist& now, const Twist& wanted, double dt_s, const RobotModel& robot);

}  // namespace cairn::live
