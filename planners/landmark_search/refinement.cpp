#include "planners/landmark_search/refinement.hpp"

#include <algorithm>
#include <unordered_map>

namespace cairn {

namespace {

void append_route(const Network& network, VertexIndex from, VertexIndex to, GraphPath& path) {
  path.routes.push_back(network.cheapest(from, to)->route);
  path.vertices.push_back(to);
}

}  // namespace

// Along the tree of paths from boundary vertex `from`, which leads back from its inner vertices.
void append_passage(const Hierarchy& hierarchy, ClusterIndex cluster, std::size_t from, std::size_t to,
                    GraphPath& path) {
  const Passage& passage = hierarchy.overlay().passage(cluster);
  const ClusterNode& node = hierarchy.clustering().node(cluster);
  const std::uint16_t* const before = passage.before.data() + from * passage.inner.size();
  std::vector<std::uint16_t> chain{passage.at[to]};
  while (chain.back() != passage.at[from]) chain.push_back(before[chain.back()]);
  for (std::size_t i = chain.size() - 1; i > 0; --i) {
    const std::size_t p = chain[i];
    const std::size_t q = chain[i - 1];
    const std::size_t member = node.level == 1 ? 0 : passage.member_of(p);
    const bool within = node.level > 1 && passage.member_of(q) == member;
    if (within)
      append_passage(hierarchy, node.members[member], p - passage.member_begin[member],
                     q - passage.member_begin[member], path);
    else
      append_route(hierarchy.network(), passage.inner[p], passage.inner[q], path);
  }
}

void remove_loops(GraphPath& path) {
  std::vector<VertexIndex> rising = path.vertices;
  std::sort(rising.begin(), rising.end());
  if (std::adjacent_find(rising.begin(), rising.end()) == rising.end()) return;
  std::unordered_map<VertexIndex, std::size_t> at;
  at.reserve(path.vertices.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < path.vertices.size(); ++i) {
    const auto [first, fresh] = at.emplace(path.vertices[i], kept);
    if (!fresh) {
      for (std::size_t k = first->second + 1; k < kept; ++k) at.erase(path.vertices[k]);
      kept = first->second;
    } else if (kept > 0) {
      path.routes[kept - 1] = path.routes[i - 1];
    }
    path.vertices[kept++] = path.vertices[i];
  }
  path.vertices.resize(kept);
  path.routes.resize(kept == 0 ? 0 : kept - 1);
}

}  // namespace cairn
