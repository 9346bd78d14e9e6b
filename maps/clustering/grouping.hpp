// Cutting a graph into connected groups of bounded size: METIS proposes, we check and repair.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace cairn {

// Undirected; every edge stands at both of its ends, none twice, and none leads back to its node.
struct GroupingGraph {
  std::vector<std::int32_t> begin{0};  // the edges of node i are begin[i] .. begin[i + 1] - 1
  std::vector<std::int32_t> other;
  std::vector<std::int32_t> weight;  // of an edge: what cutting it costs, at least 1
  std::vector<std::int32_t> size;    // of a node: landmarks in it, at least 1

  [[nodiscard]] std::int32_t nodes() const { return static_cast<std::int32_t>(size.size()); }
};

// The number of a group for every node, from 0; numbers may be missing and groups may be in several pieces.
using Proposal = std::function<std::vector<std::int32_t>(const GroupingGraph& graph, std::int32_t groups)>;
// Few and long routes cut, even sizes. The same graph gives the same groups. Not for several threads at once.
[[nodiscard]] std::vector<std::int32_t> propose_by_metis(const GroupingGraph& graph, std::int32_t groups);

// The number of its group for each node, from 0 and none missing, by the lowest node. Every group is connected
// and at most `most` large (a larger node is a group alone). What the proposal leaves in pieces, too large or
// below a quarter of `most` is repaired; a small group stays when none of its neighbours has room.
[[nodiscard]] std::vector<std::int32_t> connected_groups(const GroupingGraph& graph, std::int32_t most,
                                                         const Proposal& propose = propose_by_metis);

// The numbers of the connected parts, as above.
[[nodiscard]] std::vector<std::int32_t> connected_parts(const GroupingGraph& graph);

}  // namespace cairn
