// Counts how often exploring was blocked without getting on, and which places it was blocked on the way to.
#pragma once

#include <vector>

#include "maps/geometry/map_move.hpp"
#include "plugins/behaviours/exploring/settings.hpp"

namespace cairn::behaviours {

class BlockageCount {
 public:
  explicit BlockageCount(const ExploreBlockedSettings& settings) : settings_(settings) {}

  // Blocked once more, after a drive of this length since the beginning.
  void add(double driven_m);
  // Whether the robot was blocked on the way to about this place before.
  [[nodiscard]] bool add_failed(const Point& place);
  void restart() { in_a_row_ = 0; }
  // The map has been exchanged; null: places are worth nothing.
  void move(const MapMove* move);

  [[nodiscard]] bool is_any() const { return in_a_row_ > 0; }
  [[nodiscard]] bool is_too_many() const { return in_a_row_ > settings_.max_in_a_row; }

 private:
  ExploreBlockedSettings settings_;
  int in_a_row_ = 0;
  double driven_at_last_m_ = 0.0;
  std::vector<Point> failed_;
};

}  // namespace cairn::behaviours
