#include "planners/disc_space/space_cache.hpp"

#include "maps/differing_cells.hpp"

namespace cairn {

std::shared_ptr<const DiscSpace> SpaceCache::space_of(const OccupancyGrid& grid, const GroundRules& rules,
                                                      std::uint64_t version) const {
  const std::lock_guard lock(mutex_);
  const auto same_grid = [&] { return version != 0 ? version == last_->version : last_->grid == grid; };
  if (!last_ || !(last_->space.rules() == rules))
    last_ = std::make_shared<const Entry>(Entry{grid, DiscSpace(grid, rules), version});
  else if (!same_grid())
    last_ = std::make_shared<const Entry>(
        Entry{grid, DiscSpace(last_->space, grid, differing_cells(last_->grid, grid)), version});
  return {last_, &last_->space};
}

bool SpaceCache::empty() const {
  const std::lock_guard lock(mutex_);
  return last_ == nullptr;
}

}  // namespace cairn
