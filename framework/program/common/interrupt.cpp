#include "framework/program/common/interrupt.hpp"

#include <csignal>

namespace cairn {
namespace {

ControlFlags flags;  // a signal handler can reach nothing else
static_assert(std::atomic<bool>::is_always_lock_free);

void on_interrupt(int signal) {
  flags.cancel.store(true, std::memory_order_relaxed);
  std::signal(signal, SIG_DFL);
}

void on_pause(int signal) {
  flags.pause.store(signal == SIGUSR1, std::memory_order_relaxed);
}

}  // namespace

const std::atomic<bool>& cancel_on_interrupt() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  return flags.cancel;
}

ControlFlags& flags_of_signals() {
  (void)cancel_on_interrupt();
  std::signal(SIGUSR1, on_pause);
  std::signal(SIGUSR2, on_pause);
  return flags;
}

}  // namespace cairn
