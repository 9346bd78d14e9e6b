// How well an edge fits a solved pose graph, the edge itself left out: what the rest of the graph says, with how sure
// it is of that. An edge between two ends that hang together loosely fits almost anywhere, so that its fitting says
// little.
#pragma once

#include <span>
#include <vector>

#include "maps/pose_graph/pose_graph.hpp"

namespace cairn {

struct LeftOutFit {
  double chi2 = 0.0;  // of the edge's error, with the covariance of the edge and of the rest of the graph
  // Logarithm of how much likelier the error is than that of an edge to anywhere on the map.
  double log_odds = 0.0;
};

// Which edges to look at, and which are part of the solution T_map_node of `graph` and these. Those not looked at have
// no fit, nor have edges of which nothing can be said (a chi2 of infinity). Three linear systems an edge.
[[nodiscard]] std::vector<LeftOutFit> left_out_fits(const PoseGraph& graph, std::span<const PoseEdge> edges,
                                                    const std::vector<bool>& is_part, const std::vector<bool>& is_asked,
                                                    const std::vector<Pose2>& T_map_node);

}  // namespace cairn
