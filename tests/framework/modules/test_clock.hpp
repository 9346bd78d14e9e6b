// A wall clock that only the test moves on; who sleeps moves it on by as much and never waits.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "framework/modules/wall_clock.hpp"

namespace cairn {

class TestClock final : public WallClock {
 public:
  [[nodiscard]] Time now() const override { return Time(std::chrono::nanoseconds(now_ns_.load())); }
  void sleep_for(std::chrono::nanoseconds duration) const override { now_ns_ += duration.count(); }
  [[nodiscard]] bool wait_for(const std::future<void>& done, std::chrono::nanoseconds /*at_most*/) const override {
    ++waits_;
    std::this_thread::yield();
    return done.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }

  void advance(std::chrono::nanoseconds duration) { now_ns_ += duration.count(); }
  // How often somebody has waited for something.
  [[nodiscard]] int waits() const { return waits_; }
  [[nodiscard]] double seconds() const { return 1e-9 * static_cast<double>(now_ns_.load()); }

 private:
  mutable std::atomic<std::int64_t> now_ns_{1};
  mutable std::atomic<int> waits_{0};
};

}  // namespace cairn
