// Whether the mission is paused, as its user wants it.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "framework/contracts/budget.hpp"
#include "framework/mission/events.hpp"
#include "framework/mission/run_control.hpp"
#include "framework/modules/wall_clock.hpp"

namespace cairn {

class Pauses {
 public:
  // control: null: nobody pauses it.
  Pauses(RunControl* control, std::shared_ptr<const WallClock> wall_clock)
      : control_(control), wall_clock_(std::move(wall_clock)) {}

  [[nodiscard]] bool is_wanted() const;
  [[nodiscard]] bool is_paused() const { return is_paused_; }

  // Of a mission that drives, once a tick: pauses it or lets it go on. Paused or Resumed when that is a change.
  // paused_s: of the mission so far.
  [[nodiscard]] std::optional<Event> apply(double paused_s);
  // At the mission's end: Resumed when it was paused.
  [[nodiscard]] std::optional<Event> end(double paused_s) const;
  // Of a mission on a log, which has no robot to stop: it is read on later. hold() pauses it; wait() returns when no
  // pause is wanted any more or the budget is cancelled, and calls looks again and again until then.
  void hold() { is_paused_ = true; }
  void wait(const Budget& budget, const std::function<void()>& looks);

 private:
  RunControl* control_;
  std::shared_ptr<const WallClock> wall_clock_;
  bool is_paused_ = false;
  double paused_before_s_ = 0.0;  // when this pause began
};

}  // namespace cairn
