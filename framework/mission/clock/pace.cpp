#include "framework/mission/clock/pace.hpp"

#include <algorithm>

namespace cairn {
namespace {

// In short waits: a log may hold a gap of hours, and the user may want to end it in there.
constexpr std::chrono::nanoseconds kMaxWait = std::chrono::milliseconds(20);

}  // namespace

void Pace::keep(double stamp_s, const Budget& budget, double factor) {
  if (!begin_ || begin_->factor != factor) begin_ = Begin{wall_clock_->now(), stamp_s, factor};
  const std::chrono::duration<double> until((stamp_s - begin_->stamp_s) / factor);
  while (!budget.cancelled()) {
    const std::chrono::duration<double> rest = until - (wall_clock_->now() - begin_->wall);
    if (rest.count() <= 0.0) return;
    const std::chrono::duration<double> wait = std::min<std::chrono::duration<double>>(rest, kMaxWait);
    wall_clock_->sleep_for(std::chrono::ceil<std::chrono::nanoseconds>(wait));
  }
}

}  // namespace cairn
