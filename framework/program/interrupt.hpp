// Ctrl-C as a cancel flag: the mission ends at its next tick, the robot stops, the map is saved.
#pragma once

#include <atomic>

namespace cairn {

// The flag that SIGINT and SIGTERM raise; a second signal ends the program at once.
[[nodiscard]] const std::atomic<bool>& cancel_on_interrupt();

}  // namespace cairn
