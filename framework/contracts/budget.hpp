// How long a call may take: a deadline, a cancel flag, a count of iterations.
//
// Every call that may take long gets one and returns as soon as it is exhausted, with the outcome
// that says so. Iterations are for answers that must not depend on the machine's speed.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>

namespace cairn {

struct Budget {
  using Clock = std::chrono::steady_clock;

  Clock::time_point deadline = Clock::time_point::max();
  const std::atomic<bool>* cancel = nullptr;
  std::int64_t iterations = std::numeric_limits<std::int64_t>::max();

  [[nodiscard]] bool cancelled() const { return cancel != nullptr && cancel->load(std::memory_order_relaxed); }
  [[nodiscard]] bool past_deadline() const { return deadline != Clock::time_point::max() && Clock::now() >= deadline; }
  [[nodiscard]] bool exhausted() const { return cancelled() || past_deadline(); }
};

}  // namespace cairn
