// A process of its own that stops the wheels when this one cannot: killed, stopped by a signal, or hanging as a whole.
// The microcontroller's own watchdog waits two seconds.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <span>

#include "framework/live/descriptor.hpp"

namespace cairn::p2os_robot {

class WheelGuard {
 public:
  // Writes the bytes to the port when no beat has come for so long, again and again until one comes, and a last time
  // when this process or the guard ends. Throws std::runtime_error when no process can be made.
  WheelGuard(int port, std::span<const std::uint8_t> stop, std::chrono::milliseconds silence);
  ~WheelGuard();
  WheelGuard(const WheelGuard&) = delete;
  WheelGuard& operator=(const WheelGuard&) = delete;

  // This process lives. Without waiting.
  void beat() noexcept;
  // False once a beat has found that somebody has ended the guard.
  [[nodiscard]] bool is_there() const { return is_there_; }

 private:
  Descriptor beats_;
  pid_t process_ = -1;
  std::atomic<bool> is_there_{true};
};

}  // namespace cairn::p2os_robot
