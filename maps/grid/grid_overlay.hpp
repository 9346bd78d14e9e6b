// One grid laid over another: which cell of b lies under a cell of a.
#pragma once

#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

// Throws std::invalid_argument unless the cells are of one size, to a billionth.
void check_same_cell_size(const OccupancyGrid& a, const OccupancyGrid& b);

// The cell of b that holds the centre of a's cell; of two that touch there the upper or right one.
[[nodiscard]] Cell cell_under(const OccupancyGrid& a, Cell cell_of_a, const OccupancyGrid& b, const Pose2& T_b_a);

// The smallest box of a's lattice that holds all of b's bounds.
[[nodiscard]] CellBox box_over(const OccupancyGrid& a, const OccupancyGrid& b, const Pose2& T_a_b);

// Adds b's evidence to a, cell by cell: the log-odds of cell_under() are added and kept within a's clamp. So what one
// grid knows and the other does not stays as it is known, what both say alike gets surer, what they contradict in
// becomes doubtful. a's lattice stays, and grows where b's known cells lie outside. A grid a without cells gets b's
// cell size, and b's lattice where T_a_b turns nothing. Throws std::invalid_argument for different cell sizes,
// std::length_error when a would get too large.
[[nodiscard]] OccupancyGrid with_evidence_of(const OccupancyGrid& a, const OccupancyGrid& b, const Pose2& T_a_b);

}  // namespace cairn
