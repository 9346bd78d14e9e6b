#include "framework/safety/fatal_ends.hpp"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "framework/modules/making.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxMissions = 64;
constexpr std::size_t kStackBytes = std::size_t{64} << 10U;
constexpr int kExitOfFailure = 1;
constexpr std::array kFatalSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGABRT, SIGQUIT};
// End the process by default too. Profilers look whether theirs are free: SIGPROF and SIGVTALRM are left to them.
constexpr std::array kUnhandledSignals{SIGALRM, SIGXCPU, SIGIO, SIGSTKFLT, SIGPWR};
constexpr int kMaxLooksForStop = 30;
constexpr timespec kBetweenLooks{0, 5'000'000};

// A signal handler can reach nothing else.
std::array<std::atomic<FatalEnds*>, kMaxMissions> missions;
std::array<struct sigaction, kFatalSignals.size()> earlier;
std::atomic<bool> is_end_expected{false};
std::atomic<pid_t> our_process{0};
static_assert(std::atomic<FatalEnds*>::is_always_lock_free && std::atomic<std::thread::id>::is_always_lock_free);

// Where the process was ended.
enum class Place { this_thread, outside };

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
    case SIGQUIT:
      return "SIGQUIT";
    case SIGINT:
      return "a second SIGINT";
    case SIGTERM:
      return "a second SIGTERM";
    case SIGABRT:
      return "SIGABRT";
    case SIGALRM:
      return "SIGALRM";
    case SIGTRAP:
      return "SIGTRAP";
    case SIGSYS:
      return "SIGSYS";
    case SIGXCPU:
      return "SIGXCPU";
    case SIGIO:
      return "SIGIO";
    case SIGSTKFLT:
      return "SIGSTKFLT";
    case SIGPWR:
      return "SIGPWR";
    default:
      return "a signal";
  }
}

}  // namespace

// All in signal handlers: no locks, no memory.
struct FatalEndHandlers {
  static void stop_all(const char* what, Place place) {
    for (std::atomic<FatalEnds*>& slot : missions)
      if (FatalEnds* const mission = slot; mission != nullptr && mission->is_running_)
        mission->monitor_.stop_for_good();
    for (std::atomic<FatalEnds*>& slot : missions)
      if (FatalEnds* const mission = slot; mission != nullptr && mission->is_running_) report(*mission, what, place);
  }

  // Whether a module is being made in this thread.
  static bool report_making(const char* what) {
    const char* const module = module_being_made_here();
    if (module == nullptr) return false;
    print("cairn: ");
    print(what);
    print(" while module ");
    print(module);
    print(" was being made\n");
    return true;
  }

  static void report(const FatalEnds& mission, const char* what, Place place) {
    bool is_sent = mission.monitor_.is_stop_sent();
    for (int i = 0; i < kMaxLooksForStop && !is_sent; ++i) {
      ::nanosleep(&kBetweenLooks, nullptr);
      is_sent = mission.monitor_.is_stop_sent();
    }
    const bool is_elsewhere = mission.thread_.load() != std::this_thread::get_id();
    const StageClock::Id stage = mission.clock_.current();
    print("cairn: ");
    print(what);
    print(place == Place::outside ? " while the mission was"
          : is_elsewhere          ? " in another thread, while the mission was"
                                  : "");
    print(" in stage ");
    print(mission.clock_.stage_of(stage).c_str());
    print(stage == StageClock::kHost ? "" : " of module ");
    print(mission.clock_.module_of(stage).c_str());
    print(is_sent ? "; the robot was stopped\n" : "; a stop was asked for\n");
  }

  static void on_signal(int signal, siginfo_t* info, void* context) {
    const bool is_sent_to_us = info->si_code == SI_USER || signal == SIGQUIT;
    stop_all(name_of_signal(signal), is_sent_to_us ? Place::outside : Place::this_thread);
    if (!is_sent_to_us) (void)report_making(name_of_signal(signal));
    for (std::size_t i = 0; i < kFatalSignals.size(); ++i) {
      if (kFatalSignals[i] != signal) continue;
      if ((earlier[i].sa_flags & SA_SIGINFO) != 0) return earlier[i].sa_sigaction(signal, info, context);
      if (earlier[i].sa_handler != SIG_DFL && earlier[i].sa_handler != SIG_IGN) return earlier[i].sa_handler(signal);
    }
    end(signal);
  }

  // Of kUnhandledSignals.
  static void on_unhandled(int signal) {
    stop_all(name_of_signal(signal), Place::outside);
    end(signal);
  }

  static void end(int signal) {
    ::signal(signal, SIG_DFL);
    ::raise(signal);
  }

  [[noreturn]] static void end_early();

  static void on_exit() {
    if (our_process != ::getpid()) return;  // a child that a module has forked
    if (module_being_made_here() != nullptr) {
      stop_all("exit() was called", Place::outside);
      end_early();
    }
    bool is_left_to_others = false;
    for (std::atomic<FatalEnds*>& slot : missions) {
      FatalEnds* const mission = slot;
      if (mission == nullptr || !mission->is_running_) continue;
      if (!is_left_to_others) stop_all("exit() was called", Place::this_thread);
      const bool is_mission = mission->thread_.load() == std::this_thread::get_id();
      if (mission->watcher_ == std::this_thread::get_id() ||
          (is_mission && mission->clock_.current() == StageClock::kHost))
        ::_exit(kExitOfFailure);  // nobody would be left to end the mission
      (is_mission ? mission->exit_was_called_ : mission->exit_was_called_elsewhere_) = true;
      is_left_to_others = true;
    }
    if (is_left_to_others)
      for (;;) ::pause();  // the thread that watches ends the process
    if (!is_end_expected) end_early();
  }
};

// Of exit() outside of every mission, not in a signal handler.
[[noreturn]] void FatalEndHandlers::end_early() {
  if (!report_making("exit() was called")) print("cairn: exit() was called by a module or a library\n");
  ::_exit(kExitOfFailure);
}

void expect_end() {
  is_end_expected = true;
}

void end_by_signal(int signal) {
  FatalEndHandlers::stop_all(name_of_signal(signal), Place::outside);
  FatalEndHandlers::end(signal);
}

void handle_fatal_ends() {
  static std::once_flag once;
  std::call_once(once, [] {
    struct sigaction action {};
    action.sa_sigaction = FatalEndHandlers::on_signal;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
    ::sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < kFatalSignals.size(); ++i) ::sigaction(kFatalSignals[i], &action, &earlier[i]);
    for (const int signal : kUnhandledSignals) {
      struct sigaction before {};
      ::sigaction(signal, nullptr, &before);
      if ((before.sa_flags & SA_SIGINFO) == 0 && before.sa_handler == SIG_DFL)
        ::signal(signal, FatalEndHandlers::on_unhandled);
    }
    our_process = ::getpid();
    (void)std::at_quick_exit(FatalEndHandlers::on_exit);
  });
  (void)std::atexit(FatalEndHandlers::on_exit);
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
