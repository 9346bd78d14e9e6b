// Ends the program when a module's making does not come back: no mission watches over that yet.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

namespace cairn {

class MakingWatch {
 public:
  struct Limits {
    double max_s = 0.0;                     // of a module that is to be made at once; 0: none
    const std::atomic<bool>& is_cancelled;  // by the user: whatever is being made gets 2 s more
  };
  // sentence: for people. It is called by another thread, and must not return: std::_Exit().
  using End = std::function<void(const std::string& sentence, bool is_cancelled)>;

  // As long as it lives.
  MakingWatch(const Limits& limits, End end);

 private:
  void watch(const std::stop_token& ended) const;

  Limits limits_;
  End end_;
  std::jthread thread_;  // last: it uses all of the above
};

inline constexpr double kMaxMaking_s = 60.0;  // of a module, for a command that sees to many missions
// What a mission's watchdog_s leaves for the making of a module: as much, and 10 s at least; of 0: no limit, as 0.
[[nodiscard]] double max_making_s(double watchdog_s);
// For a command that has no report to write: it ends with one line and status 2; cancelled, with status 1.
[[nodiscard]] MakingWatch watch_making(double max_s, const std::atomic<bool>& is_cancelled);

}  // namespace cairn
