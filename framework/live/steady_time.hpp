// Seconds by a clock of this computer that never steps.
#pragma once

#include <chrono>

namespace cairn::live {

[[nodiscard]] inline double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace cairn::live
