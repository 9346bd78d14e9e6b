// How long wheels turn after something has happened, for docs/results/stopping.md.
#pragma once

#include <iostream>
#include <string>

#include "framework/live/steady_time.hpp"

namespace cairn {

class TimeToStand {
 public:
  explicit TimeToStand(std::string after) : after_(std::move(after)) {}
  // stands(within_s) waits for it; half a second is what every base has.
  template <class Stands>
  [[nodiscard]] bool is_short(Stands stands) const {
    const bool is_short = stands(0.5);
    std::cout << after_ << ": velocity 0 after " << live::now_s() - begin_s_ << " s\n";
    return is_short;
  }

 private:
  std::string after_;
  double begin_s_ = live::now_s();
};

}  // namespace cairn
