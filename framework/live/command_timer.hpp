// What is ordered of the wheels: a command counts for its time, then they are to stand.
#pragma once

#include "maps/geometry/pose.hpp"

namespace cairn::live {

// All times by one clock that does not step.
class CommandTimer {
 public:
  void order(const Twist& twist, double valid_for_s, double now_s) {
    twist_ = twist;
    until_s_ = now_s + valid_for_s;
  }
  void stop() { twist_ = {}; }
  [[nodiscard]] Twist ordered(double now_s) const { return now_s < until_s_ ? twist_ : Twist{}; }

 private:
  Twist twist_;
  double until_s_ = 0.0;
};

}  // namespace cairn::live
