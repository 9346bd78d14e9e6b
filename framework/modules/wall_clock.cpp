#include "framework/modules/wall_clock.hpp"

#include <thread>

namespace cairn {

WallClock::Time SteadyClock::now() const {
  return std::chrono::steady_clock::now();
}

void SteadyClock::sleep_for(std::chrono::nanoseconds duration) const {
  std::this_thread::sleep_for(duration);
}

bool SteadyClock::wait_for(const std::future<void>& done, std::chrono::nanoseconds at_most) const {
  return done.wait_for(at_most) == std::future_status::ready;
}

}  // namespace cairn
