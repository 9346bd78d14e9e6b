// The part of a large map that one question needs.
//
// A path between two points that leaves a box of cells is at least so long as the straight lines to its rim and on. So
// an answer found inside the box, no longer than that, is as good as any on the whole map.
#pragma once

#include <optional>

#include "framework/contracts/planner.hpp"

namespace cairn {

struct MapEnds {
  Point from;
  Point to;
};

// Where a request begins and ends; none when it leaves the choice of several places.
[[nodiscard]] std::optional<MapEnds> ends_of(const PlanRequest& request, const LandmarkGraph& graph);

// Whether no stored route of the graph counts less than the straight way between its ends, nor than by way of any place
// on its trajectory, so that lengths bound its costs.
[[nodiscard]] bool costs_are_lengths(const LandmarkGraph& graph);

// The cells that ways of that length can pass, and `around_m` more on each side; within `whole`, the bounds of the
// grid. Only the grid's lattice is asked.
[[nodiscard]] CellBox part_for(const MapEnds& ends, double length_m, double around_m, const OccupancyGrid& lattice,
                               const CellBox& whole);

// No path that comes within `around_m` of the rim of `part` is shorter, where the map goes on behind it; +inf where it
// does not.
[[nodiscard]] double min_outside_m(const MapEnds& ends, const CellBox& part, double around_m,
                                   const OccupancyGrid& lattice, const CellBox& whole);

}  // namespace cairn
