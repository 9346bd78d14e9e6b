// The machine's clock, passed in: a test brings one of its own and never waits.
#pragma once

#include <chrono>
#include <future>

namespace cairn {

// Thread-safe.
class WallClock {
 public:
  using Time = std::chrono::steady_clock::time_point;

  virtual ~WallClock() = default;
  [[nodiscard]] virtual Time now() const = 0;
  virtual void sleep_for(std::chrono::nanoseconds duration) const = 0;
  // Until `done` is ready, at most so long; whether it is.
  [[nodiscard]] virtual bool wait_for(const std::future<void>& done, std::chrono::nanoseconds at_most) const = 0;
};

class SteadyClock final : public WallClock {
 public:
  [[nodiscard]] Time now() const override;
  void sleep_for(std::chrono::nanoseconds duration) const override;
  [[nodiscard]] bool wait_for(const std::future<void>& done, std::chrono::nanoseconds at_most) const override;
};

}  // namespace cairn
