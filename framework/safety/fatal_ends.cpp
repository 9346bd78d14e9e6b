#include "framework/safety/fatal_ends.hpp"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <mutex>

namespace cairn {
namespace {

constexpr std::size_t kMaxMissions = 64;
constexpr std::size_t kStackBytes = std::size_t{64} << 10U;
constexpr int kExitOfFailure = 1;
constexpr std::array kFatalSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

// A signal handler can reach nothing else.
std::array<std::atomic<FatalEnds*>, kMaxMissions> missions;
std::array<struct sigaction, kFatalSignals.size()> earlier;
static_assert(std::atomic<FatalEnds*>::is_always_lock_free && std::atomic<std::thread::id>::is_always_lock_free);

// Async-signal-safe.
void print(const char* text) {
  const std::size_t length = std::strlen(text);
  if (::write(STDERR_FILENO, text, length) < 0) return;  // there is nowhere else to report it
}

const char* name_of_signal(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "SIGSEGV";
    case SIGBUS:
      return "SIGBUS";
    case SIGFPE:
      return "SIGFPE";
    case SIGILL:
      return "SIGILL";
    default:
      return "SIGABRT";
  }
}

}  // namespace

// All in signal handlers: no locks, no memory.
struct FatalEndHandlers {
  static void stop_all(const char* what) {
    for (std::atomic<FatalEnds*>& slot : missions) {
      FatalEnds* const mission = slot;
      if (mission == nullptr || !mission->is_running_) continue;
      mission->monitor_.stop_at_once();
      const StageClock::Id stage = mission->clock_.current();
      print("cairn: ");
      print(what);
      print(" in stage ");
      print(mission->clock_.stage_of(stage).c_str());
      print(stage == StageClock::kHost ? "" : " of module ");
      print(mission->clock_.module_of(stage).c_str());
      print("; the robot was stopped\n");
    }
  }

  static void on_signal(int signal, siginfo_t* info, void* context) {
    stop_all(name_of_signal(signal));
    for (std::size_t i = 0; i < kFatalSignals.size(); ++i) {
      if (kFatalSignals[i] != signal) continue;
      if ((earlier[i].sa_flags & SA_SIGINFO) != 0) return earlier[i].sa_sigaction(signal, info, context);
      if (earlier[i].sa_handler != SIG_DFL && earlier[i].sa_handler != SIG_IGN) return earlier[i].sa_handler(signal);
    }
    ::signal(signal, SIG_DFL);
    ::raise(signal);
  }

  static void on_exit() {
    for (std::atomic<FatalEnds*>& slot : missions) {
      FatalEnds* const mission = slot;
      if (mission == nullptr || !mission->is_running_) continue;
      stop_all("exit() was called");
      const bool is_the_modules =
          mission->thread_.load() == std::this_thread::get_id() && mission->clock_.current() != StageClock::kHost;
      if (!is_the_modules) ::_exit(kExitOfFailure);
      mission->exit_was_called_ = true;
      while (true) ::pause();  // the thread that watches ends the process
    }
  }
};

void handle_fatal_ends() {
  static std::once_flag once;
  std::call_once(once, [] {
    struct sigaction action {};
    action.sa_sigaction = FatalEndHandlers::on_signal;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
    ::sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < kFatalSignals.size(); ++i) ::sigaction(kFatalSignals[i], &action, &earlier[i]);
    (void)std::atexit(FatalEndHandlers::on_exit);
  });
}

FatalEnds::FatalEnds(CollisionMonitor& monitor, const StageClock& clock) : monitor_(monitor), clock_(clock) {
  for (std::atomic<FatalEnds*>& slot : missions) {
    FatalEnds* none = nullptr;
    if (slot.compare_exchange_strong(none, this)) return;
  }
}

FatalEnds::~FatalEnds() {
  for (std::atomic<FatalEnds*>& slot : missions) {
    FatalEnds* mine = this;
    if (slot.compare_exchange_strong(mine, nullptr)) return;
  }
}

FatalEnds::Thread::Thread(FatalEnds& ends) : ends_(ends) {
  ends_.thread_ = std::this_thread::get_id();
  ends_.is_running_ = true;
}

FatalEnds::Thread::~Thread() {
  ends_.is_running_ = false;
}

std::shared_ptr<void> alternate_stack() {
  struct Stack {
    Stack() {
      stack_t stack{};
      stack.ss_sp = memory.get();
      stack.ss_size = kStackBytes;
      ::sigaltstack(&stack, &earlier);
    }
    ~Stack() { ::sigaltstack(&earlier, nullptr); }
    Stack(const Stack&) = delete;
    Stack& operator=(const Stack&) = delete;
    std::unique_ptr<char[]> memory = std::make_unique<char[]>(kStackBytes);
    stack_t earlier{};
  };
  return std::make_shared<Stack>();
}

}  // namespace cairn
