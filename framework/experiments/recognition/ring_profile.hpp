// Where the landmarks' outlines lie in a map: mean OL by the signed distance from the true outline. A drawn template
// fits only if its ring lies where that of the map does.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/contracts/world.hpp"
#include "framework/experiments/statistics.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

inline constexpr double kProfileBegin_m = -0.15;  // inside the outline
inline constexpr double kProfileEnd_m = 0.20;     // outside
inline constexpr double kProfileStep_m = 0.01;
inline constexpr int kProfileBins = 35;

// Sums over the cells whose centres lie in a bin.
struct RingProfile {
  std::vector<double> ol = std::vector<double>(kProfileBins, 0.0);
  std::vector<std::int64_t> cells = std::vector<std::int64_t>(kProfileBins, 0);

  RingProfile& operator+=(const RingProfile& more);
  // Distance from the outline to the middle of the ring: mean of the bins, each by its mean OL above 127. 0 without a
  // ring.
  [[nodiscard]] double ring_at_m() const;
};

// Of all landmarks of the world.
[[nodiscard]] RingProfile ring_profile(const OccupancyGrid& grid, const World& world);

}  // namespace cairn
