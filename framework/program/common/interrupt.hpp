// Signals to a running mission: Ctrl-C cancels it at its next tick (the robot stops, the map is saved), SIGUSR1 pauses
// it, SIGUSR2 lets it go on.
#pragma once

#include "framework/mission/run_control.hpp"

namespace cairn {

// The flag that SIGINT and SIGTERM raise; a second one ends the program at once.
[[nodiscard]] const std::atomic<bool>& cancel_on_interrupt();
// The same flag, and the one that SIGUSR1 raises and SIGUSR2 takes back.
[[nodiscard]] ControlFlags& flags_of_signals();

}  // namespace cairn
