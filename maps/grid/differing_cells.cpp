#include "maps/grid/differing_cells.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace cairn {

CellBox differing_cells(const OccupancyGrid& a, const OccupancyGrid& b) {
  constexpr int kSide = OccupancyGrid::kTileSide;
  constexpr std::array<LogOdds, kSide * kSide> kUnknown{};
  const CellBox bounds = united(a.bounds(), b.bounds());
  CellBox differing;
  if (bounds.empty()) return differing;
  for (int y = bounds.min.y >> 6; y <= (bounds.max.y - 1) >> 6; ++y)
    for (int x = bounds.min.x >> 6; x <= (bounds.max.x - 1) >> 6; ++x) {
      const LogOdds* const in_a = a.cells_of_tile({x, y});
      const LogOdds* const in_b = b.cells_of_tile({x, y});
      const std::span<const LogOdds> cells_a(in_a != nullptr ? in_a : kUnknown.data(), kUnknown.size());
      const std::span<const LogOdds> cells_b(in_b != nullptr ? in_b : kUnknown.data(), kUnknown.size());
      if (std::equal(cells_a.begin(), cells_a.end(), cells_b.begin())) continue;
      differing = united(differing, {{x * kSide, y * kSide}, {(x + 1) * kSide, (y + 1) * kSide}});
    }
  return differing;
}

}  // namespace cairn
