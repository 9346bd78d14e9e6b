// Which edges of a pose graph another one near by agrees with: the loop over both, and over the two pieces of the way
// between their ends, comes back to where it began (Mangelson and others, "Pairwise consistent measurement set
// maximization", ICRA 2018). False edges seldom agree with each other by chance.
#pragma once

#include <span>
#include <vector>

#include "maps/pose_graph/pose_graph.hpp"

namespace cairn {

struct WitnessSettings {
  std::size_t nodes_apart = 10;  // at either end, at most
  double chi2_limit = 7.81;      // of the loop: 95 % of three degrees of freedom
};

// The graph's nodes are in the order of the way, its edges from a node to the next say how sure a step is (where there
// is none, the mean of the others); T_map_node: the way by itself. O(pairs * nodes_apart).
[[nodiscard]] std::vector<bool> have_witnesses(std::span<const PoseEdge> edges, const PoseGraph& graph,
                                               std::span<const Pose2> T_map_node, const WitnessSettings& settings = {});

}  // namespace cairn
