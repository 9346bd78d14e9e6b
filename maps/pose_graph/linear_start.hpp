// A first solution of a pose graph by two linear systems: headings as free vectors, then positions (Carlone and others,
// "Initialization techniques for 3D SLAM: a survey on rotation estimation", ICRA 2015: the chordal relaxation).
#pragma once

#include <optional>
#include <vector>

#include "maps/pose_graph/pose_graph.hpp"

namespace cairn {

// Node 0 stays where it is. Independent of the other poses so far; the sensors' errors are as believed so
// far. None when edges do not connect the graph.
[[nodiscard]] std::optional<std::vector<Pose2>> linear_start(const PoseGraph& graph);

}  // namespace cairn
