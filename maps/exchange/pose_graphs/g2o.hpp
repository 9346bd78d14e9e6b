// Pose graphs in the text format of g2o, planar: VERTEX_SE2, EDGE_SE2.
//
//   VERTEX_SE2 ID X Y THETA
//   EDGE_SE2 FROM TO DX DY DTHETA I11 I12 I13 I22 I23 I33
//   FIX ID, and # comments, are read over
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "maps/pose_graph/pose_graph.hpp"

namespace cairn {

struct G2oGraph {
  PoseGraph graph;                // nodes in the order of the file
  std::vector<std::int64_t> ids;  // of the nodes
};

// Throws ExchangeError with file:line:column on any other line, on ids that are there twice or not at all, and on
// numbers that are not finite. A file without vertices has those that its
// edges name, at the origin; otherwise a vertex that only edges name is refused.
[[nodiscard]] G2oGraph parse_g2o(std::string_view text, const std::string& file_name);
// With these poses in place of the graph's own, one for each id.
[[nodiscard]] std::string g2o_of(const G2oGraph& graph, std::span<const Pose2> T_map_node);

}  // namespace cairn
