#include "framework/program/common/interrupt.hpp"

#include <time.h>  // NOLINT(modernize-deprecated-headers): clock_gettime

#include <atomic>
#include <csignal>
#include <cstdint>

#include "framework/safety/fatal_ends.hpp"

namespace cairn {
namespace {

ControlFlags flags;  // a signal handler can reach nothing else
constexpr std::int64_t kNever_ms = -1;
std::atomic<std::int64_t> terminated_ms{kNever_ms};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

void on_interrupt(int signal) {
  flags.cancel.store(true, std::memory_order_relaxed);
  std::signal(signal, end_by_signal);
}

// timeout(1) sends it to the program and to the program's group: a second one so soon is the same.
void on_termination(int signal) {
  constexpr std::int64_t kSame_ms = 200;
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t now_ms = std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1'000'000;
  std::int64_t first_ms = kNever_ms;
  if (terminated_ms.compare_exchange_strong(first_ms, now_ms))
    flags.cancel.store(true, std::memory_order_relaxed);
  else if (now_ms - first_ms > kSame_ms)
    end_by_signal(signal);
}

// A shell sends it once more to what its terminal's end has reached already.
void on_hang_up(int) {
  flags.cancel.store(true, std::memory_order_relaxed);
}

void on_pause(int signal) {
  flags.pause.store(signal == SIGUSR1, std::memory_order_relaxed);
}

}  // namespace

const std::atomic<bool>& cancel_on_interrupt() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_termination);
  if (std::signal(SIGHUP, on_hang_up) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // started by nohup
  std::signal(SIGPIPE, SIG_IGN);  // who reads what is printed may go; what is written is checked
  return flags.cancel;
}

ControlFlags& flags_of_signals() {
  (void)cancel_on_interrupt();
  std::signal(SIGUSR1, on_pause);
  std::signal(SIGUSR2, on_pause);
  return flags;
}

}  // namespace cairn
