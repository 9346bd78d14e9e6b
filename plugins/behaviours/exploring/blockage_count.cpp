#include "plugins/behaviours/exploring/blockage_count.hpp"

#include <algorithm>

#include "plugins/behaviours/places/map_watch.hpp"

namespace cairn::behaviours {

void BlockageCount::add(double driven_m) {
  in_a_row_ = driven_m - driven_at_last_m_ < settings_.progress_m ? in_a_row_ + 1 : 1;
  driven_at_last_m_ = driven_m;
}

bool BlockageCount::add_failed(const Point& place) {
  const bool is_again =
      std::ranges::any_of(failed_, [&](const Point& p) { return (p - place).norm() < settings_.failed_again_m; });
  failed_.push_back(place);
  return is_again;
}

void BlockageCount::move(const MapMove* move) {
  if (move == nullptr)
    failed_.clear();
  else
    move_places(*move, failed_);
}

}  // namespace cairn::behaviours
