// Whether the map has been drawn anew: landmarks and the robot have their places in the new one, and what a behaviour
// keeps in coordinates of the old one is worth nothing.
#pragma once

#include "framework/contracts/world_view.hpp"

namespace cairn::behaviours {

class MapWatch {
 public:
  // Every tick. A map stays one object as long as it is only added to.
  [[nodiscard]] bool has_moved(const WorldView& world) {
    const OccupancyGrid* const before = grid_;
    grid_ = &world.grid;
    return before != nullptr && before != grid_;
  }

 private:
  const OccupancyGrid* grid_ = nullptr;
};

}  // namespace cairn::behaviours
