#include "framework/program/common/interrupt.hpp"

#include <csignal>

#include "framework/safety/fatal_ends.hpp"

namespace cairn {
namespace {

ControlFlags flags;  // a signal handler can reach nothing else
static_assert(std::atomic<bool>::is_always_lock_free);

void on_interrupt(int signal) {
  flags.cancel.store(true, std::memory_order_relaxed);
  std::signal(signal, end_by_signal);
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
  std::signal(SIGTERM, on_interrupt);
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
