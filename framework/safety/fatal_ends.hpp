// When the process ends in the middle of a mission (a fatal signal, std::terminate, exit() called by a module), the
// wheels are stopped first, and one line on standard error says in which module and stage the mission was, and whether
// it was its thread that failed. A drive whose stop is sent by another thread (StopReport) gets up to 0.15 s for that.
//
// What ends the process without any of these (kill -9, _exit) leaves the wheels to the drive itself: a command counts
// for a time only.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "framework/modules/stage_clock.hpp"
#include "framework/safety/collision_monitor.hpp"

namespace cairn {

// For the program: installs handlers for SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGABRT and SIGQUIT, which
// go on to what was installed before; for SIGALRM, SIGXCPU, SIGIO, SIGSTKFLT and SIGPWR where nobody handles them; and
// for exit() and quick_exit(), which end the process with status 1 and a line, whoever calls them, until expect_end().
// When it is called again, what has been loaded since is torn down after the mission has been stopped.
void handle_fatal_ends();
// main() returns next.
void expect_end();

// In a signal handler: the same for a signal that asks the process to end a second time.
void end_by_signal(int signal);

// A mission that the handlers know, from construction to destruction; at most 64 at a time, the rest are not known. The
// thread that makes it is the one that watches the mission.
class FatalEnds {
 public:
  FatalEnds(CollisionMonitor& monitor, const StageClock& clock);
  ~FatalEnds();
  FatalEnds(const FatalEnds&) = delete;
  FatalEnds& operator=(const FatalEnds&) = delete;

  // The mission's thread, while it lives.
  class Thread {
   public:
    explicit Thread(FatalEnds& ends);
    ~Thread();
    Thread(const Thread&) = delete;
    Thread& operator=(const Thread&) = delete;

   private:
    FatalEnds& ends_;
  };

  // The module that the mission is in has called exit(), in the mission's thread: that call never returns, and whoever
  // watches gives the mission up.
  [[nodiscard]] bool exit_was_called() const { return exit_was_called_; }
  // exit() was called in a thread that is neither the mission's nor the one that watches. That call never returns; the
  // wheels stand, and the mission ends itself.
  [[nodiscard]] bool exit_was_called_elsewhere() const { return exit_was_called_elsewhere_; }

 private:
  friend struct FatalEndHandlers;

  CollisionMonitor& monitor_;
  const StageClock& clock_;
  std::atomic<bool> is_running_{false};
  std::atomic<std::thread::id> thread_{};
  const std::thread::id watcher_ = std::this_thread::get_id();
  std::atomic<bool> exit_was_called_{false};
  std::atomic<bool> exit_was_called_elsewhere_{false};
};

// A stack for signal handlers of this thread, so that they can run when its own has overflowed; as long as it is held.
[[nodiscard]] std::shared_ptr<void> alternate_stack();

}  // namespace cairn
