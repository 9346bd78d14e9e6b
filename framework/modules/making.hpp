// Which modules are being made, and since when. A constructor that hangs, crashes or calls exit() is in no mission's
// stage yet: who watches the process learns here whose it is.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace cairn {

// From construction to destruction, in the thread that makes the module. Modules that others make are made in between.
class ModuleMaking {
 public:
  // may_take_long: it may read a log first, or wait for a robot.
  explicit ModuleMaking(std::string module, bool may_take_long = false);
  ~ModuleMaking();
  ModuleMaking(const ModuleMaking&) = delete;
  ModuleMaking& operator=(const ModuleMaking&) = delete;

 private:
  friend struct MakingNow;

  const std::string module_;
  const bool may_take_long_;
  mutable std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  const ModuleMaking* const outer_;  // of the same thread
};

struct ModuleBeingMade {
  std::string module;
  double for_s = 0.0;  // by the wall clock, since it began or another was made for it
  bool may_take_long = false;
};

// The innermost of the thread that has been at its one for longest; thread-safe.
[[nodiscard]] std::optional<ModuleBeingMade> module_being_made();
// Of this thread; null: none. In a signal handler too.
[[nodiscard]] const char* module_being_made_here() noexcept;

}  // namespace cairn
