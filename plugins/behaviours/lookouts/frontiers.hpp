// What is worth driving to: frontiers, and edges that have not been looked at from near.
#pragma once

#include <optional>
#include <vector>

#include "plugins/behaviours/local_map/free_space.hpp"

namespace cairn::behaviours {

// A free cell with an unknown one beside it.
[[nodiscard]] bool is_frontier(const FreeSpace& space, Cell cell);
// The same for an occupied cell with a free one beside it.
[[nodiscard]] bool is_edge(const FreeSpace& space, Cell cell);

// All of them, row by row.
[[nodiscard]] std::vector<Cell> frontier_cells(const FreeSpace& space);
[[nodiscard]] std::vector<Cell> edge_cells(const FreeSpace& space);
// Occupied cells with a free one no more than so many cells away in x and y: edges that were seen from afar often have
// a strip before them that is not known.
[[nodiscard]] std::vector<Cell> far_edge_cells(const FreeSpace& space, int within_cells);

// Where to stand to look at a group of cells: the cheapest cell in reach from which the path to the
// group, over free cells, or over all that are not occupied, is at most within_m. One answer a group; none where there
// is no such cell.
[[nodiscard]] std::vector<std::optional<Cell>> lookouts(const FreeSpace& space, const std::vector<CellGroup>& groups,
                                                        double within_m, bool over_unknown = false);

}  // namespace cairn::behaviours
