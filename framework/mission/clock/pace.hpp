// Keeps a mission down to the pace of the wall clock.
#pragma once

#include <memory>
#include <optional>

#include "framework/contracts/budget.hpp"
#include "framework/modules/wall_clock.hpp"

namespace cairn {

class Pace {
 public:
  explicit Pace(std::shared_ptr<const WallClock> wall_clock) : wall_clock_(std::move(wall_clock)) {}

  // Sleeps until as much wall clock has passed since the pace began as the stamps say, divided by the factor (> 0), or
  // the budget is cancelled. With another factor than before it begins afresh.
  void keep(double stamp_s, const Budget& budget, double factor = 1.0);
  // The next keep() begins afresh.
  void release() { begin_.reset(); }
  [[nodiscard]] bool is_kept() const { return begin_.has_value(); }

 private:
  struct Begin {
    WallClock::Time wall;
    double stamp_s = 0.0;
    double factor = 1.0;
  };

  std::shared_ptr<const WallClock> wall_clock_;
  std::optional<Begin> begin_;  // wall clock and observations go together from here on
};

}  // namespace cairn
