// The part of graph_lint.hpp that compares the graph with the grid: whom the robot could reach.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "maps/edit/graph_lint.hpp"
#include "maps/landmarks/joined_landmarks.hpp"

namespace cairn {

// What the grid of level 0 says of the landmarks of that level; nothing without a grid.
struct PlaceLint {
  std::vector<LintFinding> missing_routes;      // one for each two sets of landmarks that only the grid joins
  std::map<LandmarkId, std::string> no_places;  // why there is no place to stand at a landmark
  JoinedLandmarks on_grid;                      // between whose places the robot's disc can drive
};

// O(cells log cells). The places are the approach poses where the disc fits, else the nearest cells to these within
// kPlaceReach_m; from there it drives from cell centre to cell centre (disc_lattice.hpp).
inline constexpr double kPlaceReach_m = 1.5;
[[nodiscard]] PlaceLint lint_places(const LandmarkGraph& graph, const OccupancyGrid& grid, const LintOptions& options);

// A landmark's reason as a finding of its own.
[[nodiscard]] std::vector<LintFinding> lint_no_places(const LandmarkGraph& graph, const PlaceLint& places);

}  // namespace cairn
