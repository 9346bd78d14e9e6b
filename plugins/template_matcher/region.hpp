// Where to match (docs/method.md 5; paper section 3.2).
#pragma once

#include <vector>

#include "maps/grid/coarse_grid.hpp"
#include "maps/landmarks/landmark_template.hpp"

namespace cairn::template_matcher {

// Greatest Distance8, in coarse cells, from the trigger cell.
struct RegionReach {
  int start = 0;  // of the neighbourhood that the smallest landmark fills: always searched
  int most = 0;   // of the neighbourhood that the largest landmark may fill

  // How far the searched cells may lie from occupied ones: the centre of an L or of a door frame stands in
  // the open. 0 when every landmark covers its own centre.
  int open = 0;

  [[nodiscard]] static RegionReach of(double smallest_diameter_m, double largest_diameter_m, double coarse_cell_m);
  [[nodiscard]] static RegionReach of(const TemplateSet& set, double coarse_cell_m);
};

// Coarse cells to search, sorted by (y, x): the starting neighbourhood, extended by 8-adjacent cells
// of the grid with OL2 > tau_grow within the largest neighbourhood, and all of it widened by `open`.
[[nodiscard]] std::vector<Cell> grow_region(const CoarseGrid& coarse, Cell trigger, const RegionReach& reach,
                                            double tau_grow);

// The OG1 cells below, as spans sorted by (y, x).
[[nodiscard]] std::vector<CellSpan> fine_spans(const CoarseGrid& coarse, const std::vector<Cell>& region);

}  // namespace cairn::template_matcher
