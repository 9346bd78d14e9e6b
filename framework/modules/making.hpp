// Which modules are being made, and since when. A constructor that hangs or calls exit() is in no mission's stage yet:
// who watches the process learns here whose it is.
#pragma once

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
};

struct ModuleBeingMade {
  std::string module;
  double for_s = 0.0;  // by the wall clock
  bool may_take_long = false;
};

// The innermost of the thread that has been at its one for longest; thread-safe.
[[nodiscard]] std::optional<ModuleBeingMade> module_being_made();
// Of this thread.
[[nodiscard]] std::optional<std::string> module_being_made_here();

}  // namespace cairn
