// Plain ways to cluster, to measure ours against.
#pragma once

#include "maps/clustering/clustering.hpp"

namespace cairn {

// Regions grown breadth first by Boost.Graph, one after the other, each from the first node that is left.
[[nodiscard]] std::vector<std::int32_t> propose_by_growth(const GroupingGraph& graph, std::int32_t groups);

// By coordinates alone: boxes that are halved, across their longest side and so that both halves hold as many
// landmarks, until none holds too many. Floors are `floor_m` apart. Boxes may hold several pieces: who takes the
// tree over splits these.
[[nodiscard]] ClusterTree clusters_by_coordinates(const LandmarkGraph& graph, const ClusterSizes& sizes,
                                                  double floor_m);

}  // namespace cairn
