// Signals to a running mission: Ctrl-C cancels it at its next tick (the robot stops, the map is saved), SIGUSR1 pauses
// it, SIGUSR2 lets it go on.
#pragma once

#include "framework/mission/run_control.hpp"

namespace cairn {

// The flag that SIGINT, SIGTERM and SIGHUP raise; a second SIGINT or SIGTERM stops the wheels and ends the program at
// once. SIGHUP is left ignored where it was. From then on SIGPIPE is ignored: a reader of the output that goes away
// ends nothing.
[[nodiscard]] const std::atomic<bool>& cancel_on_interrupt();
// The same flag, and the one that SIGUSR1 raises and SIGUSR2 takes back.
[[nodiscard]] ControlFlags& flags_of_signals();

}  // namespace cairn
