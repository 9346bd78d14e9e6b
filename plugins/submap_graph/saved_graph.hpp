// The graph of a run, and of those that it went on from, as the saved map keeps it.
#pragma once

#include <span>

#include "maps/submaps/kept_submaps.hpp"
#include "plugins/submap_graph/laser_graph.hpp"

namespace cairn::submap_graph {

// earlier: what the graph began with, as it was saved. node_stamps_s: of all of the graph's nodes. A run whose robot
// has stood adds nothing to it, and what newer submaps cover is left out.
[[nodiscard]] KeptSubmaps saved_graph(const KeptSubmaps& earlier, const LaserGraph& laser_graph,
                                      std::span<const double> node_stamps_s, const Config& config);

}  // namespace cairn::submap_graph
