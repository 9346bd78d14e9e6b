#include "framework/mission/clock/pauses.hpp"

namespace cairn {
namespace {

constexpr std::chrono::milliseconds kLookEvery(20);

}  // namespace

bool Pauses::is_wanted() const {
  return control_ != nullptr && control_->flags().pause.load(std::memory_order_relaxed);
}

std::optional<Event> Pauses::apply(double paused_s) {
  if (is_wanted() == is_paused_) return std::nullopt;
  is_paused_ = !is_paused_;
  if (!is_paused_) return Resumed{paused_s - paused_before_s_};
  paused_before_s_ = paused_s;
  return Paused{};
}

std::optional<Event> Pauses::end(double paused_s) const {
  if (!is_paused_) return std::nullopt;
  return Resumed{paused_s - paused_before_s_};
}

void Pauses::wait(const Budget& budget, const std::function<void()>& looks) {
  while (is_wanted() && !budget.cancelled()) {
    looks();
    wall_clock_->sleep_for(kLookEvery);
  }
  is_paused_ = false;
}

}  // namespace cairn
