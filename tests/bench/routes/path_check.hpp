// Whether a path is one, from the rules alone: cells are closed squares, a path may touch a closed one and run along
// it, not enter it, not pass between two that share a side or meet at a corner, and it leads from end to end.
//
// Shares no code with the planners. Plain work: every cell that is near a segment is looked at.
#pragma once

#include <span>
#include <string>

#include "tests/bench/routes/plain_cells.hpp"

namespace cairn {

inline constexpr double kPathTolerance_cells = 1e-6;  // what rounding may do

// For a point; positions in metres of the map. Empty when the path is right, else what is wrong with it.
[[nodiscard]] std::string fault_of_point_path(const PlainCells& cells, std::span<const Point> path, const Point& from,
                                              const Point& to);
// For a disc: no closed cell is nearer than its radius.
[[nodiscard]] std::string fault_of_disc_path(const PlainCells& cells, std::span<const Point> path, const Point& from,
                                             const Point& to, double radius_m);

// The least distance from the path to a closed cell; 0 when it enters one, at most `reach_m`.
[[nodiscard]] double distance_to_closed_m(const PlainCells& cells, std::span<const Point> path, double reach_m);
[[nodiscard]] double length_of_m(std::span<const Point> path);

}  // namespace cairn
