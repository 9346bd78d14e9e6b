#include "framework/mission/clock/mission_clock.hpp"

namespace cairn {

void MissionClock::restore(double time_s, double paused_s) {
  resumed_s_ = time_s_ = time_s;
  paused_s_ = paused_s;
}

double MissionClock::advance(double stamp_s, bool is_paused) {
  if (!begin_stamp_s_) begin_stamp_s_ = stamp_s - resumed_s_.value_or(0.0);
  if (is_paused) {
    *begin_stamp_s_ += stamp_s - last_stamp_s_;
    paused_s_ += stamp_s - last_stamp_s_;
  }
  last_stamp_s_ = stamp_s;
  has_begun_ = true;
  time_s_ = stamp_s - *begin_stamp_s_;
  return time_s_;
}

double MissionClock::replay(double stamp_s) {
  if (!begin_stamp_s_) begin_stamp_s_ = stamp_s;
  return stamp_s - *begin_stamp_s_;
}

}  // namespace cairn
