// What matchings and the map say of one landmark, as time goes on.
#pragma once

#include "framework/contracts/detector.hpp"
#include "maps/geometry/contour.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// Adds what the matching says of the place: the degrees of the categories that fit within within_m of the
// landmark; what does not fit says nothing. The category that fits best now becomes the landmark's, the pose and degree
// are those of its best matching so far. The newest matching decides alone, because its map holds all that the earlier
// ones saw: means over matchings, fast or slow, named the wrong category more often. Returns whether category, pose or
// degree changed.
bool add_evidence(Landmark& landmark, const Matching& matching, double within_m);

// The same, but category, pose and degree stay: for one that may be of another landmark.
void count_evidence(Landmark& landmark, const Matching& matching, double within_m);

// Puts the evidence of one landmark to that of another.
void add_evidence(Landmark& landmark, const Landmark& other);

// Share of a landmark's own cells, those inside its outline, that the map holds to be free: 0.5 at most where
// it stands, as nothing sees into it, and near 1 once it has been taken away. A shape without a cell inside: 0.
[[nodiscard]] double freed_ratio(const OccupancyGrid& grid, const Contour& contour, const Pose2& T_map_landmark);

}  // namespace cairn
