// Finds the poses by which the chi2 of a pose graph is least: Levenberg and Marquardt from the better of a linear start
// and the poses so far, with a sparse Cholesky decomposition, and with them the errors of the sensors that the graph
// expects. Every edge is believed (robust_solver.hpp: not all).
// Deterministic.
#pragma once

#include <functional>
#include <vector>

#include "maps/pose_graph/pose_graph.hpp"

namespace cairn {

struct PoseGraphSettings {
  int max_iterations = 100;        // linear systems solved
  double relative_change = 1e-10;  // of chi2 in one step, at which it has converged
  bool linear_start = true;        // or only from the poses so far
};

struct PoseGraphSolution {
  std::vector<Pose2> T_map_node;
  SensorErrors errors;
  double chi2 = 0.0;
  int iterations = 0;  // linear systems solved
  bool converged = false;
};

// Node 0 stays where it is, but for its heading when the graph has headings. Throws std::invalid_argument on an edge or
// heading of a node that is not there, on groups that are numbered beyond the headings, on values that are not finite,
// on a negative information. `cancelled` is asked before each linear system; the best so far is returned then.
[[nodiscard]] PoseGraphSolution solve(const PoseGraph& graph, const PoseGraphSettings& settings = {},
                                      const std::function<bool()>& cancelled = {});

// Standard deviations of the errors that are looked for, in the order of ErrorRows: given all measurements. None when
// the graph does not determine its poses.
[[nodiscard]] std::vector<double> deviations_of(const PoseGraph& graph, const PoseGraphSolution& solution);

}  // namespace cairn
