#include "planners/disc_space/space_cache.hpp"

namespace cairn {

std::shared_ptr<const DiscSpace> SpaceCache::space_of(const OccupancyGrid& grid, const GroundRules& rules) const {
  std::shared_ptr<const Entry> entry;
  {
    const std::lock_guard lock(mutex_);
    entry = last_;
  }
  const bool same = entry && entry->space.rules() == rules && entry->grid == grid;
  if (!same) {
    entry = std::make_shared<const Entry>(Entry{grid, DiscSpace(grid, rules)});
    const std::lock_guard lock(mutex_);
    last_ = entry;
  }
  return {entry, &entry->space};
}

}  // namespace cairn
