// What differs between two saved maps of one frame.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "maps/landmarks/landmark_pairs.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

struct MapDifference {
  // Cells by their state in a and in b (CellState as index), over all cells that either grid has; beyond a grid all is
  // unknown.
  std::array<std::array<std::int64_t, 3>, 3> cells{};
  std::int64_t other_probability = 0;  // of the same state, but with other log-odds

  std::vector<LandmarkPair> same;     // at the same place, to a hundredth of a millimetre
  std::vector<LandmarkPair> moved;    // found again elsewhere
  std::vector<LandmarkPair> renamed;  // of both kinds above
  std::vector<LandmarkId> only_in_a;
  std::vector<LandmarkId> only_in_b;

  std::vector<std::pair<RouteId, RouteId>> routes_same;
  std::vector<std::pair<RouteId, RouteId>> routes_changed;  // another cost, or closed in one of them only
  std::vector<RouteId> routes_only_in_a;
  std::vector<RouteId> routes_only_in_b;

  [[nodiscard]] std::int64_t cells_of_other_state() const;
  [[nodiscard]] bool is_same() const;
};

// Landmarks are the same thing when they are near_pairs() within near_m, or else have the same id and category, or the
// same category and name. Routes are when they join the same things in the same direction; of several, those of nearest
// cost. Cells are compared by place, a's against the cell of b under its centre. Nothing else of the maps is compared.
// Throws std::invalid_argument when both have grids and these have cells of different size.
[[nodiscard]] MapDifference difference_of(const SavedMap& a, const SavedMap& b, double near_m = 0.4);

}  // namespace cairn
