#include "maps/hierarchy/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "maps/base/in_parallel.hpp"
#include "maps/hierarchy/inner_search.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxInner = 65'535;         // numbers of inner vertices are 16 bits wide
constexpr std::size_t kMaxKeptCosts = 4'000'000;  // boundary x inner vertices of one cluster

std::size_t inner_count(const Clustering& clustering, const ClusterNode& node) {
  if (node.level == 1) return node.members.size();
  std::size_t count = 0;
  for (const ClusterIndex member : node.members) count += clustering.node(member).boundary.size();
  return count;
}

void transpose_through(Passage& passage) {
  const std::size_t count = passage.boundary();
  const std::size_t inner = passage.inner.size();
  passage.through.resize(count * count);
  passage.through_back.resize(count * count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      const double cost = passage.cost[i * inner + passage.at[j]];
      passage.through[i * count + j] = cost;
      passage.through_back[j * count + i] = cost;
    }
}

void set_cost(std::vector<Arc>& arcs, RouteId route, double cost, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t a = begin; a < end; ++a)
    if (arcs[a].route == route) arcs[a].cost = cost;
}

}  // namespace

std::uint32_t position_of(std::span<const std::uint32_t> rising, std::uint32_t v) {
  const auto at = std::lower_bound(rising.begin(), rising.end(), v);
  if (at == rising.end() || *at != v) throw std::logic_error(fmt::format("position_of: {} is not in the list", v));
  return static_cast<std::uint32_t>(at - rising.begin());
}

std::size_t Passage::member_of(std::size_t n) const {
  return static_cast<std::size_t>(std::upper_bound(member_begin.begin(), member_begin.end(), n) -
                                  member_begin.begin()) -
         1;
}

bool Overlay::is_bounded(const Clustering& clustering, int level) {
  for (ClusterIndex c = 0; c < clustering.end(); ++c) {
    const ClusterNode& node = clustering.node(c);
    if (node.level != level) continue;
    const std::size_t inner = inner_count(clustering, node);
    if (inner > kMaxInner || inner * node.boundary.size() > kMaxKeptCosts) return false;
  }
  return true;
}

void Overlay::list_inner(const Clustering& clustering, ClusterIndex cluster) {
  const ClusterNode& node = clustering.node(cluster);
  Passage& passage = passages_[cluster];
  passage = {};
  if (node.level == 1) {
    passage.inner = node.members;
  } else {
    for (const ClusterIndex member : node.members) {
      const auto& boundary = clustering.node(member).boundary;
      passage.member_begin.push_back(static_cast<std::uint32_t>(passage.inner.size()));
      passage.inner.insert(passage.inner.end(), boundary.begin(), boundary.end());
    }
    passage.member_begin.push_back(static_cast<std::uint32_t>(passage.inner.size()));
  }
  if (passage.inner.size() > kMaxInner)
    throw std::length_error(fmt::format("Overlay: cluster {} has too many inner vertices", node.id));
  for (const VertexIndex v : node.boundary)
    passage.at.push_back(static_cast<std::uint16_t>(inner_index(clustering, cluster, v)));
}

void Overlay::list_arcs(const Network& network, const Clustering& clustering, ClusterIndex cluster) {
  const ClusterNode& node = clustering.node(cluster);
  Passage& passage = passages_[cluster];
  const auto list = [&](const std::vector<Arc>& arcs, std::vector<Arc>& crossing, std::vector<std::uint32_t>& begin) {
    for (const Arc& arc : arcs)
      if (clustering.cluster_of(arc.other, node.level) != cluster) crossing.push_back(arc);
    begin.push_back(static_cast<std::uint32_t>(crossing.size()));
  };
  passage.out_begin = {0};
  passage.in_begin = {0};
  for (const VertexIndex v : node.boundary) {
    list(network.out(v), passage.out, passage.out_begin);
    list(network.in(v), passage.in, passage.in_begin);
  }
}

std::uint32_t Overlay::inner_index(const Clustering& clustering, ClusterIndex cluster, VertexIndex v) const {
  const ClusterNode& node = clustering.node(cluster);
  if (node.level == 1) return position_of(node.members, v);
  const ClusterIndex member = clustering.cluster_of(v, node.level - 1);
  return passages_[cluster].member_begin[position_of(node.members, member)] +
         position_of(clustering.node(member).boundary, v);
}

void Overlay::make(const Network& network, const Clustering& clustering, ClusterIndex cluster) {
  list_inner(clustering, cluster);
  list_arcs(network, clustering, cluster);
  Passage& passage = passages_[cluster];
  const std::size_t inner = passage.inner.size();
  passage.cost.resize(passage.boundary() * inner);
  passage.before.resize(passage.boundary() * inner);
  InnerGraph graph(network, clustering, cluster, *this);
  for (std::size_t i = 0; i < passage.boundary(); ++i)
    graph.search(passage.at[i], std::span(passage.cost).subspan(i * inner, inner),
                 std::span(passage.before).subspan(i * inner, inner));
  transpose_through(passage);
}

void Overlay::list_parents(const Clustering& clustering) {
  parents_.resize(clustering.end());
  for (ClusterIndex c = 0; c < clustering.end(); ++c) parents_[c] = clustering.node(c).parent;
}

void Overlay::build(const Network& network, const Clustering& clustering) {
  list_parents(clustering);
  passages_.assign(clustering.end(), {});
  for (int level = 1; level <= clustering.levels(); ++level) {
    const std::vector<ClusterIndex> clusters = clustering.of_level(level);
    in_parallel(clusters.size(), [&](std::size_t i) { make(network, clustering, clusters[i]); });
  }
}

void Overlay::follow(const Network& network, const Clustering& clustering, const Clustering::Upkeep& upkeep,
                     std::span<const VertexIndex> vertices) {
  if (upkeep.levels_changed) return build(network, clustering);
  list_parents(clustering);
  passages_.resize(clustering.end());
  std::set<std::pair<int, ClusterIndex>> clusters;  // by rising level
  const auto add_with_ancestors = [&](ClusterIndex cluster) {
    for (; cluster != kNoCluster; cluster = clustering.node(cluster).parent)
      if (!clusters.emplace(clustering.node(cluster).level, cluster).second) return;
  };
  for (const ClusterIndex cluster : upkeep.touched)
    if (clustering.node(cluster).level > 0)
      add_with_ancestors(cluster);
    else
      passages_[cluster] = {};
  for (const VertexIndex v : vertices) add_with_ancestors(clustering.leaf_of(v));
  for (const auto& [level, cluster] : clusters) make(network, clustering, cluster);
}

// In the lists of the clusters that the arc leaves and enters; inside the lowest cluster that holds both ends it is
// a change of the inner graph.
void Overlay::take_over(const Clustering& clustering, const CostChange& change, InnerChanges& changes) {
  ClusterIndex from = clustering.leaf_of(change.from);
  ClusterIndex to = clustering.leaf_of(change.to);
  for (; from != to; from = clustering.node(from).parent, to = clustering.node(to).parent) {
    Passage& left = passages_[from];
    const std::uint32_t i = position_of(clustering.node(from).boundary, change.from);
    set_cost(left.out, change.route, change.after, left.out_begin[i], left.out_begin[i + 1]);
    Passage& entered = passages_[to];
    const std::uint32_t j = position_of(clustering.node(to).boundary, change.to);
    set_cost(entered.in, change.route, change.after, entered.in_begin[j], entered.in_begin[j + 1]);
  }
  if (from != kNoCluster)
    changes[from].push_back({inner_index(clustering, from, change.from), inner_index(clustering, from, change.to),
                             change.before, change.after});
}

void Overlay::recost(const Network& network, const Clustering& clustering, ClusterIndex cluster,
                     const std::vector<InnerChange>& changes, InnerChanges& above) {
  Passage& passage = passages_[cluster];
  const std::size_t inner = passage.inner.size();
  const std::size_t count = passage.boundary();
  const auto is_affected = [&](std::size_t i) {
    const double* const cost = passage.cost.data() + i * inner;
    const std::uint16_t* const before = passage.before.data() + i * inner;
    return std::any_of(changes.begin(), changes.end(), [&](const InnerChange& change) {
      return change.after > change.before ? before[change.to] == change.from
                                          : cost[change.from] + change.after < cost[change.to];
    });
  };
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < count; ++i)
    if (is_affected(i)) rows.push_back(i);
  if (rows.empty()) return;
  InnerGraph graph(network, clustering, cluster, *this);
  const ClusterIndex parent = clustering.node(cluster).parent;
  const std::uint32_t first =
      parent == kNoCluster ? 0 : passages_[parent].member_begin[position_of(clustering.node(parent).members, cluster)];
  for (const std::size_t i : rows) {
    graph.search(passage.at[i], std::span(passage.cost).subspan(i * inner, inner),
                 std::span(passage.before).subspan(i * inner, inner));
    for (std::size_t j = 0; j < count; ++j) {
      const double old = passage.through[i * count + j];
      const double now = passage.cost[i * inner + passage.at[j]];
      if (old == now) continue;
      passage.through[i * count + j] = now;
      passage.through_back[j * count + i] = now;
      if (parent != kNoCluster)
        above[parent].push_back(
            {first + static_cast<std::uint32_t>(i), first + static_cast<std::uint32_t>(j), old, now});
    }
  }
}

void Overlay::recost(const Network& network, const Clustering& clustering, std::span<const CostChange> changes) {
  InnerChanges waiting;
  for (const CostChange& change : changes) take_over(clustering, change, waiting);
  for (int level = 1; level <= clustering.levels(); ++level) {
    InnerChanges above;
    for (const auto& [cluster, inner_changes] : waiting)
      if (clustering.node(cluster).level == level)
        recost(network, clustering, cluster, inner_changes, above);
      else
        above[cluster].insert(above[cluster].end(), inner_changes.begin(), inner_changes.end());
    waiting = std::move(above);
  }
}

std::size_t Overlay::bytes() const {
  const auto size = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
  std::size_t bytes = size(passages_);
  for (const Passage& p : passages_)
    bytes += size(p.through) + size(p.through_back) + size(p.out_begin) + size(p.in_begin) + size(p.out) + size(p.in) +
             size(p.inner) + size(p.member_begin) + size(p.at) + size(p.cost) + size(p.before);
  return bytes;
}

}  // namespace cairn
