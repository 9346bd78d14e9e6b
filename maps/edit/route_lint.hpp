// The part of graph_lint.hpp that looks at routes.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "maps/edit/graph_lint.hpp"
#include "maps/geometry/pose.hpp"

namespace cairn {

struct Blockage {
  Point at_m{0.0, 0.0};                // centre of the blocked cell
  CellState by = CellState::occupied;  // never free
};

// Where a disc that moves along the trajectory first touches an occupied cell; without one, where it first
// touches an unknown cell or leaves the grid. Exact (swept_disc.hpp).
[[nodiscard]] std::optional<Blockage> blockage_on(std::span<const Pose2> trajectory, const OccupancyGrid& grid,
                                                  double radius_m);

[[nodiscard]] std::vector<LintFinding> lint_routes(const LandmarkGraph& graph, const OccupancyGrid& grid,
                                                   const LintOptions& options);

// "door (L5)", or "L5" of one without a name.
[[nodiscard]] std::string full_label(const Landmark& landmark);

}  // namespace cairn
