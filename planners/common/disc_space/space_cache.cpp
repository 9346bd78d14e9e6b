#include "planners/common/disc_space/space_cache.hpp"

#include "maps/grid/differing_cells.hpp"

namespace cairn {

namespace {

bool on_one_lattice(const OccupancyGrid& a, const OccupancyGrid& b) {
  return a.cell_m() == b.cell_m() && a.origin_m() == b.origin_m() && a.bounds() == b.bounds();
}

}  // namespace

std::shared_ptr<const DiscSpace> SpaceCache::space_of(const OccupancyGrid& grid, const GroundRules& rules,
                                                      std::uint64_t version) const {
  const std::lock_guard lock(mutex_);
  if (!last_ || !(last_->space.rules() == rules) || !on_one_lattice(last_->grid, grid)) {
    last_ = std::make_shared<const Entry>(Entry{grid, DiscSpace(grid, rules)});
  } else if (version == 0 || version != version_) {
    const CellBox changed = differing_cells(last_->grid, grid);
    if (!changed.empty()) last_ = std::make_shared<const Entry>(Entry{grid, DiscSpace(last_->space, grid, changed)});
  }
  version_ = version;
  return {last_, &last_->space};
}

bool SpaceCache::empty() const {
  const std::lock_guard lock(mutex_);
  return last_ == nullptr;
}

}  // namespace cairn
