#include "maps/clustering/cluster_builder.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace cairn {
namespace {

// The middle of all costs that are not zero; 0 without any.
double usual_cost(const Network& network) {
  std::vector<double> costs;
  for (VertexIndex v = 0; v < network.end(); ++v)
    for (const Arc& arc : network.out(v))
      if (arc.cost > 0.0 && arc.cost < kNoRoute) costs.push_back(arc.cost);
  if (costs.empty()) return 0.0;
  const auto middle = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 2);
  std::nth_element(costs.begin(), middle, costs.end());
  return *middle;
}

std::vector<std::vector<std::uint32_t>> groups_of(std::span<const std::uint32_t> members,
                                                  const std::vector<std::int32_t>& group_of) {
  std::vector<std::vector<std::uint32_t>> groups;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const auto group = static_cast<std::size_t>(group_of[i]);
    if (groups.size() <= group) groups.resize(group + 1);
    groups[group].push_back(members[i]);
  }
  return groups;
}

}  // namespace

// Cutting a short route costs up to ten times as much as cutting a long one: clusters come out compact.
std::int32_t ClusterBuilder::weight_of(const Arc& arc) const {
  if (!(arc.cost < kNoRoute)) return 1;
  const double sum = clustering_.usual_cost_ + arc.cost;
  return 1 + static_cast<std::int32_t>(std::lround(9.0 * (sum > 0.0 ? clustering_.usual_cost_ / sum : 1.0)));
}

template <class Visit>
void ClusterBuilder::for_each_tie(std::uint32_t member, int level, Visit visit) const {
  const auto visit_arcs = [&](VertexIndex v) {
    for (const auto* arcs : {&network_.out(v), &network_.in(v)})
      for (const Arc& arc : *arcs) {
        const std::uint32_t other = level == 1 ? arc.other : clustering_.cluster_of(arc.other, level - 1);
        if (other != member) visit(other, weight_of(arc));
      }
  };
  if (level == 1)
    visit_arcs(member);
  else
    for (const VertexIndex v : clustering_.node(member).boundary) visit_arcs(v);
}

GroupingGraph ClusterBuilder::graph_of(std::span<const std::uint32_t> members, int level) {
  const std::size_t numbers = std::max<std::size_t>(network_.end(), clustering_.end());
  if (local_.size() < numbers) local_.resize(numbers, -1);
  for (std::size_t i = 0; i < members.size(); ++i) local_[members[i]] = static_cast<std::int32_t>(i);
  GroupingGraph graph;
  std::vector<std::pair<std::int32_t, std::int32_t>> ties;
  for (const std::uint32_t member : members) {
    ties.clear();
    for_each_tie(member, level, [&](std::uint32_t other, std::int32_t weight) {
      if (local_[other] >= 0) ties.emplace_back(local_[other], weight);
    });
    std::sort(ties.begin(), ties.end());
    const auto first = graph.other.size();
    for (const auto& [other, weight] : ties) {
      if (graph.other.size() > first && graph.other.back() == other) {
        graph.weight.back() += weight;
      } else {
        graph.other.push_back(other);
        graph.weight.push_back(weight);
      }
    }
    graph.begin.push_back(static_cast<std::int32_t>(graph.other.size()));
    graph.size.push_back(level == 1 ? 1 : clustering_.node(member).landmarks);
  }
  for (const std::uint32_t member : members) local_[member] = -1;
  return graph;
}

std::map<ClusterIndex, std::int64_t> ClusterBuilder::ties_of(ClusterIndex cluster) const {
  const ClusterNode& node = clustering_.node(cluster);
  std::map<ClusterIndex, std::int64_t> ties;
  for (const std::uint32_t member : node.members)
    for_each_tie(member, node.level, [&](std::uint32_t other, std::int32_t weight) {
      const ClusterIndex neighbour = node.level == 1 ? clustering_.leaf_of(other) : clustering_.node(other).parent;
      if (neighbour != cluster) ties[neighbour] += weight;
    });
  return ties;
}

void ClusterBuilder::divide(std::span<const VertexIndex> vertices, int level, ClusterIndex parent) {
  const auto group_of = connected_groups(graph_of(vertices, 1), clustering_.sizes_.most(level), propose_);
  for (const std::vector<VertexIndex>& group : groups_of(vertices, group_of)) {
    const ClusterIndex cluster = clustering_.add(level, parent);
    if (level == 1)
      clustering_.adopt(cluster, group);
    else
      divide(group, level - 1, cluster);
  }
}

void ClusterBuilder::measure_costs() {
  clustering_.usual_cost_ = usual_cost(network_);
}

void ClusterBuilder::build() {
  clustering_.clear();
  measure_costs();
  clustering_.leaf_.assign(network_.end(), kNoCluster);
  clustering_.levels_ = std::min(clustering_.sizes_.levels_for(network_.landmarks()), clustering_.max_levels_);
  if (clustering_.levels_ == 0) return;
  std::vector<VertexIndex> all;
  for (VertexIndex v = 0; v < network_.end(); ++v)
    if (network_.landmark_of(v) != 0) all.push_back(v);
  for (const auto& part : groups_of(all, connected_parts(graph_of(all, 1))))
    divide(part, clustering_.levels_, kNoCluster);
  for (int level = 1; level <= clustering_.levels_; ++level)
    for (const ClusterIndex cluster : clustering_.of_level(level)) {
      if (level > 1) clustering_.adopt(cluster, std::vector(clustering_.node(cluster).members));
      clustering_.find_boundary(network_, cluster);
      clustering_.find_anchor(network_, cluster);
    }
}

void ClusterBuilder::add_top_level() {
  const std::vector<ClusterIndex> top = clustering_.of_level(clustering_.levels_);
  const int level = ++clustering_.levels_;
  const auto group_of = connected_groups(graph_of(top, level), clustering_.sizes_.most(level), propose_);
  for (const std::vector<ClusterIndex>& group : groups_of(top, group_of)) {
    const ClusterIndex cluster = clustering_.add(level, kNoCluster);
    clustering_.adopt(cluster, group);
    clustering_.find_boundary(network_, cluster);
    clustering_.find_anchor(network_, cluster);
  }
}

}  // namespace cairn
