// Finds the poses of a pose graph some of whose edges are false, and which of them these are.
//
// The graph's own edges (odometry) are trusted. The doubtful ones (closures) are believed as far as they agree:
//
//   1. those with a witness (edge_witnesses.hpp) get weights by graduated non-convexity, from believing all of them to
//      believing each or not (Yang and others, "Graduated non-convexity for robust spatial perception", RA-L 2020:
//      truncated least squares)
//   2. by turns: believed edges that do not fit what the rest says leave, the worst first; else, edges left out that do
//      fit come in, the surest first: their fit must be likelier than that of an edge to anywhere,
//      by the number of edges left out (left_out_fits.hpp)
//
// until both stay. Deterministic.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "maps/pose_graph/edge_witnesses.hpp"
#include "maps/pose_graph/pose_graph.hpp"
#include "maps/pose_graph/solver.hpp"

namespace cairn {

// The first edge from each node to the next one, and all others.
struct DividedGraph {
  PoseGraph odometry;
  std::vector<PoseEdge> closures;
};
[[nodiscard]] DividedGraph odometry_and_closures(const PoseGraph& graph);

struct RobustSettings {
  PoseGraphSettings solver;
  WitnessSettings witnesses;
  double chi2_limit = 11.34;           // of an edge while weights are found: 99 % of three degrees of freedom
  double left_out_chi2_limit = 16.27;  // of an edge's fit with the rest: 99.9 %
  int max_turns = 60;
};

struct RobustSolution {
  std::vector<Pose2> T_map_node;
  std::vector<bool> is_believed;  // of the doubtful edges
  double chi2 = 0.0;              // of the trusted edges and the believed ones
  bool converged = false;
  SensorErrors errors;
};

// The graph's nodes are in the order of the way, and its edges connect it. Throws and is cancelled as solve().
[[nodiscard]] RobustSolution solve_robustly(const PoseGraph& graph, std::span<const PoseEdge> doubtful,
                                            const RobustSettings& settings = {},
                                            const std::function<bool()>& cancelled = {});

}  // namespace cairn
