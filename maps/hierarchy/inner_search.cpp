#include "maps/hierarchy/inner_search.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace cairn {

InnerGraph::InnerGraph(const Network& network, const Clustering& clustering, ClusterIndex cluster,
                       const Overlay& overlay) {
  const ClusterNode& node = clustering.node(cluster);
  const Passage& passage = overlay.passage(cluster);
  nodes_ = passage.inner.size();
  begin_.push_back(0);
  if (node.level == 1) {
    for (const VertexIndex v : passage.inner) {
      for (const Arc& arc : network.out(v))
        if (arc.cost < kNoRoute && clustering.leaf_of(arc.other) == cluster)
          arcs_.push_back({arc.cost, position_of(passage.inner, arc.other)});
      begin_.push_back(static_cast<std::uint32_t>(arcs_.size()));
    }
    return;
  }
  for (std::size_t m = 0; m < node.members.size(); ++m) {
    const Passage& member = overlay.passage(node.members[m]);
    for (std::size_t i = 0; i < member.boundary(); ++i) {
      for (std::uint32_t a = member.out_begin[i]; a < member.out_begin[i + 1]; ++a) {
        const Arc& arc = member.out[a];
        const ClusterIndex other = clustering.cluster_of(arc.other, node.level - 1);
        if (!(arc.cost < kNoRoute) || clustering.node(other).parent != cluster) continue;
        const std::uint32_t first = passage.member_begin[position_of(node.members, other)];
        arcs_.push_back({arc.cost, first + position_of(clustering.node(other).boundary, arc.other)});
      }
      begin_.push_back(static_cast<std::uint32_t>(arcs_.size()));
      member_.push_back(&member);
      member_first_.push_back(passage.member_begin[m]);
    }
  }
}

void InnerGraph::relax(std::uint32_t from, std::uint32_t to, double reached, std::span<double> cost,
                       std::span<std::uint16_t> before) {
  if (!(reached < cost[to])) return;
  cost[to] = reached;
  before[to] = static_cast<std::uint16_t>(from);
  queue_.emplace_back(reached, to);
  std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

void InnerGraph::search(std::size_t source, std::span<double> cost, std::span<std::uint16_t> before) {
  std::fill(cost.begin(), cost.end(), kNoRoute);
  std::iota(before.begin(), before.end(), std::uint16_t{0});
  cost[source] = 0.0;
  queue_.assign(1, {0.0, static_cast<std::uint32_t>(source)});
  while (!queue_.empty()) {
    const auto [reached, n] = queue_.front();
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    queue_.pop_back();
    if (reached > cost[n]) continue;
    for (std::uint32_t a = begin_[n]; a < begin_[n + 1]; ++a)
      relax(n, arcs_[a].to, reached + arcs_[a].cost, cost, before);
    if (member_.empty()) continue;
    // Two ways through the same member in a row are never better than one.
    const std::uint32_t first = member_first_[n];
    if (before[n] != n && member_first_[before[n]] == first) continue;
    const std::size_t count = member_[n]->boundary();
    const double* const through = member_[n]->through.data() + (n - first) * count;
    for (std::size_t j = 0; j < count; ++j)
      relax(n, first + static_cast<std::uint32_t>(j), reached + through[j], cost, before);
  }
}

}  // namespace cairn
