#include "maps/grid/differing_cells.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace cairn {
namespace {

constexpr int kTile = OccupancyGrid::kTileSide;

// Calls visit(tile, cells of a, cells of b), row-major, for each tile in which they differ.
template <class Visit>
void for_differing_tiles(const OccupancyGrid& a, const OccupancyGrid& b, Visit&& visit) {
  static constexpr std::array<LogOdds, kTile * kTile> kUnknown{};
  const CellBox bounds = united(a.bounds(), b.bounds());
  if (bounds.empty()) return;
  for (int y = bounds.min.y >> 6; y <= (bounds.max.y - 1) >> 6; ++y)
    for (int x = bounds.min.x >> 6; x <= (bounds.max.x - 1) >> 6; ++x) {
      const LogOdds* const in_a = a.cells_of_tile({x, y});
      const LogOdds* const in_b = b.cells_of_tile({x, y});
      const std::span<const LogOdds> cells_a(in_a != nullptr ? in_a : kUnknown.data(), kUnknown.size());
      const std::span<const LogOdds> cells_b(in_b != nullptr ? in_b : kUnknown.data(), kUnknown.size());
      if (!std::equal(cells_a.begin(), cells_a.end(), cells_b.begin())) visit(Cell{x, y}, cells_a, cells_b);
    }
}

}  // namespace

CellBox differing_cells(const OccupancyGrid& a, const OccupancyGrid& b) {
  CellBox differing;
  for_differing_tiles(a, b, [&](Cell tile, auto, auto) {
    differing = united(differing, {{tile.x * kTile, tile.y * kTile}, {(tile.x + 1) * kTile, (tile.y + 1) * kTile}});
  });
  return differing;
}

std::vector<Point> centres_of_changed_states(const OccupancyGrid& before, const OccupancyGrid& after) {
  constexpr OccupancyThresholds kThresholds;
  std::vector<Point> centres;
  for_differing_tiles(before, after, [&](Cell tile, std::span<const LogOdds> old, std::span<const LogOdds> now) {
    for (int i = 0; i < kTile * kTile; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (old[at] == now[at] || kThresholds.state(old[at]) == kThresholds.state(now[at])) continue;
      centres.push_back(after.centre_of({tile.x * kTile + i % kTile, tile.y * kTile + i / kTile}));
    }
  });
  return centres;
}

}  // namespace cairn
