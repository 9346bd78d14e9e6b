// The DiscSpace of the grid that was last asked for: many queries on one saved map build it once.
#pragma once

#include <memory>
#include <mutex>

#include "planners/disc_space/disc_space.hpp"

namespace cairn {

// Compares whole grids, so that it can never answer for a grid that has changed. Thread-safe.
class SpaceCache {
 public:
  [[nodiscard]] std::shared_ptr<const DiscSpace> space_of(const OccupancyGrid& grid, const GroundRules& rules) const;

 private:
  struct Entry {
    OccupancyGrid grid;
    DiscSpace space;
  };

  mutable std::mutex mutex_;
  mutable std::shared_ptr<const Entry> last_;
};

}  // namespace cairn
