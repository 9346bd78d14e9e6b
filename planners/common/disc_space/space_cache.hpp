// The DiscSpace of the grid that was last asked for: many queries on one saved map build it once.
#pragma once

#include <memory>
#include <mutex>

#include "planners/common/disc_space/disc_space.hpp"

namespace cairn {

// Compares whole grids, unless the version (WorldView::grid_version) says that they are the same, so that it
// never answers for a grid that has changed. Thread-safe; while one caller builds, others wait for it.
class SpaceCache {
 public:
  [[nodiscard]] std::shared_ptr<const DiscSpace> space_of(const OccupancyGrid& grid, const GroundRules& rules,
                                                          std::uint64_t version = 0) const;

  [[nodiscard]] bool empty() const;

 private:
  struct Entry {
    OccupancyGrid grid;
    DiscSpace space;
  };

  mutable std::mutex mutex_;
  mutable std::shared_ptr<const Entry> last_;
  mutable std::uint64_t version_ = 0;  // of the grid; 0: not known
};

}  // namespace cairn
