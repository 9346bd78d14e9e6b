#include "maps/clustering/cluster_former.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <set>

namespace cairn {
namespace {

bool is_sound(const Cluster& cluster, ClusterId id) {
  return cluster.id == id && cluster.level == 1 && id > 0 && id <= kMaxSavedId;
}

// Where the name stays when the cluster is divided.
VertexIndex place_of_name(const Network& network, LandmarkId anchor, const std::vector<VertexIndex>& vertices) {
  const VertexIndex v = network.vertex_of(anchor);
  return std::ranges::find(vertices, v) != vertices.end() ? v : vertices.front();
}

// Which seed is the nearest to each vertex of a connected group, by routes inside it in either direction.
std::map<VertexIndex, std::size_t> nearest_seeds(const Network& network, const std::vector<VertexIndex>& group,
                                                 const std::vector<VertexIndex>& seeds) {
  using Entry = std::tuple<double, std::size_t, LandmarkId, VertexIndex>;
  const std::set<VertexIndex> inside(group.begin(), group.end());
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t i = 0; i < seeds.size(); ++i) queue.emplace(0.0, i, network.landmark_of(seeds[i]), seeds[i]);
  std::map<VertexIndex, std::size_t> nearest;
  while (!queue.empty()) {
    const auto [cost, seed, landmark, v] = queue.top();
    queue.pop();
    if (!nearest.emplace(v, seed).second) continue;
    for (const auto* arcs : {&network.out(v), &network.in(v)})
      for (const Arc& arc : *arcs)
        if (inside.contains(arc.other) && !nearest.contains(arc.other))
          queue.emplace(cost + arc.cost, seed, network.landmark_of(arc.other), arc.other);
  }
  return nearest;
}

}  // namespace

ClusterFormer::ClusterFormer(Clustering& clustering, const Network& network, const Proposal& propose,
                             const PassageWidths& widths)
    : clustering_(clustering), network_(network), propose_(propose), widths_(widths) {
  for (VertexIndex v = 0; v < network.end(); ++v)
    if (network.landmark_of(v) != 0) vertices_.push_back(v);
  std::ranges::sort(vertices_, {}, [&](VertexIndex v) { return network.landmark_of(v); });
}

void ClusterFormer::form() {
  const std::vector<Former> former = former_clusters();
  std::vector<Group> formed;
  if (is_wanted(former)) {
    formed = groups();
    divide_between_names(formed, former);
  }
  replace(formed, former);
}

std::vector<ClusterFormer::Former> ClusterFormer::former_clusters() const {
  std::map<ClusterIndex, Group> members;
  for (const VertexIndex v : vertices_)
    if (const ClusterIndex leaf = clustering_.leaf_of(v); leaf != kNoCluster) members[leaf].push_back(v);
  std::vector<Former> former;
  for (auto& [leaf, vertices] : members) {
    const ClusterNode& node = clustering_.node(leaf);
    former.push_back({node.id, node.anchor, node.name, std::move(vertices)});
  }
  std::ranges::sort(former, {}, &Former::id);
  return former;
}

// A level that is there stays for a while when landmarks go, and as long as the user's names are on it.
bool ClusterFormer::is_wanted(const std::vector<Former>& former) const {
  const std::size_t from = clustering_.sizes_.from;
  const bool has_names = std::ranges::any_of(former, [](const Former& one) { return !one.name.empty(); });
  return has_names || vertices_.size() >= (former.empty() ? from : from - from / 4);
}

std::vector<ClusterFormer::Group> ClusterFormer::groups() const {
  std::map<RouteId, double> widths;
  if (widths_)
    for (const VertexIndex v : vertices_)
      for (const Arc& arc : network_.out(v))
        if (const std::optional<double> width_m = widths_(arc.route)) widths.emplace(arc.route, *width_m);
  ClusterBuilder builder(clustering_, network_, propose_);
  builder.measure_costs();
  std::vector<Group> divided;
  const auto divide = [&](const Group& group, std::int32_t most) {
    const auto number = connected_groups(builder.graph_of(group, 1), most, propose_);
    const std::size_t first = divided.size();
    for (std::size_t i = 0; i < group.size(); ++i) {
      const std::size_t at = first + static_cast<std::size_t>(number[i]);
      if (divided.size() <= at) divided.resize(at + 1);
      divided[at].push_back(group[i]);
    }
  };
  if (widths.empty() && !vertices_.empty()) divide(vertices_, clustering_.sizes_.most_by_length(vertices_.size()));
  if (!widths.empty())
    for (const Group& group : joined_by_wide_passages(widths)) divide(group, clustering_.sizes_.leaf);
  return divided;
}

// A route of unknown width joins what it leads to.
std::vector<ClusterFormer::Group> ClusterFormer::joined_by_wide_passages(
    const std::map<RouteId, double>& widths) const {
  std::map<VertexIndex, std::vector<VertexIndex>> beside;
  for (const VertexIndex v : vertices_)
    for (const Arc& arc : network_.out(v)) {
      const auto width_m = widths.find(arc.route);
      if (width_m != widths.end() && width_m->second < clustering_.sizes_.narrow_below_m) continue;
      beside[v].push_back(arc.other);
      beside[arc.other].push_back(v);
    }
  std::vector<Group> joined;
  std::set<VertexIndex> seen;
  for (const VertexIndex first : vertices_) {
    if (!seen.insert(first).second) continue;
    Group group{first};
    for (std::size_t at = 0; at < group.size(); ++at)
      for (const VertexIndex other : beside[group[at]])
        if (seen.insert(other).second) group.push_back(other);
    std::ranges::sort(group, {}, [&](VertexIndex v) { return network_.landmark_of(v); });
    joined.push_back(std::move(group));
  }
  return joined;
}

void ClusterFormer::divide_between_names(std::vector<Group>& groups, const std::vector<Former>& former) const {
  std::vector<VertexIndex> named;
  for (const Former& one : former)
    if (!one.name.empty()) named.push_back(place_of_name(network_, one.anchor, one.vertices));
  std::vector<Group> divided;
  for (Group& group : groups) {
    std::vector<VertexIndex> seeds;
    for (const VertexIndex v : named)
      if (std::ranges::find(group, v) != group.end()) seeds.push_back(v);
    if (seeds.size() < 2) {
      divided.push_back(std::move(group));
      continue;
    }
    const std::map<VertexIndex, std::size_t> nearest = nearest_seeds(network_, group, seeds);
    std::vector<Group> parts(seeds.size());
    for (const VertexIndex v : group) parts[nearest.at(v)].push_back(v);
    std::ranges::move(parts, std::back_inserter(divided));
  }
  groups = std::move(divided);
}

// Named clusters first, then those that share most landmarks.
void ClusterFormer::replace(const std::vector<Group>& groups, const std::vector<Former>& former) {
  std::map<VertexIndex, std::size_t> group_of;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const VertexIndex v : groups[g]) group_of.emplace(v, g);
  std::vector<std::tuple<std::size_t, std::size_t, std::size_t>> claims;  // fewer landmarks than all, former, group
  for (std::size_t f = 0; f < former.size() && !groups.empty(); ++f) {
    std::map<std::size_t, std::size_t> shared;
    for (const VertexIndex v : former[f].vertices) ++shared[group_of.at(v)];
    if (!former[f].name.empty())
      claims.emplace_back(0, f, group_of.at(place_of_name(network_, former[f].anchor, former[f].vertices)));
    else
      for (const auto& [group, count] : shared) claims.emplace_back(vertices_.size() + 1 - count, f, group);
  }
  std::ranges::sort(claims);
  std::vector<const Former*> as(groups.size());
  std::set<std::size_t> placed;
  for (const auto& [rank, f, group] : claims)
    if (as[group] == nullptr && placed.insert(f).second) as[group] = &former[f];
  clustering_.clear();
  clustering_.leaf_.assign(network_.end(), kNoCluster);
  clustering_.levels_ = groups.empty() ? 0 : 1;
  for (std::size_t g = 0; g < groups.size(); ++g) add(groups[g], as[g] != nullptr ? *as[g] : Former{});
  for (ClusterIndex c = 0; c < clustering_.end(); ++c) {
    clustering_.find_boundary(network_, c);
    clustering_.find_anchor(network_, c);
  }
}

// as.id 0: it is a new one.
void ClusterFormer::add(const Group& group, const Former& as) {
  const ClusterId next_id = clustering_.next_id_;
  ClusterNode& node = clustering_.nodes_[clustering_.add(1, kNoCluster)];
  if (as.id != 0) {
    node.id = as.id;
    node.anchor = as.anchor;
    node.name = as.name;
    clustering_.next_id_ = next_id;
  }
  clustering_.adopt(static_cast<ClusterIndex>(&node - clustering_.nodes_.data()), group);
}

void ClusterFormer::restore(const ClusterTree& saved) {
  ClusterId next_id = std::clamp<ClusterId>(saved.next_id, 1, kMaxSavedId);
  std::map<ClusterId, Group> members;
  bool fits = true;
  for (const VertexIndex v : vertices_) {
    const auto leaf = saved.cluster_of.find(network_.landmark_of(v));
    const auto cluster = leaf == saved.cluster_of.end() ? saved.clusters.end() : saved.clusters.find(leaf->second);
    const bool is_placed = cluster != saved.clusters.end() && is_sound(cluster->second, cluster->first);
    fits = fits && is_placed && cluster->second.parent == 0;
    if (!is_placed) continue;
    members[cluster->first].push_back(v);
    next_id = std::max(next_id, cluster->first + 1);
  }
  clustering_.next_id_ = next_id;
  std::vector<Group> groups;
  std::vector<Former> former;
  ClusterBuilder builder(clustering_, network_, propose_);
  for (auto& [id, group] : members) {
    const Cluster& cluster = saved.clusters.at(id);
    const auto parts = connected_parts(builder.graph_of(group, 1));
    fits = fits && *std::ranges::max_element(parts) == 0 &&
           group.size() <= static_cast<std::size_t>(clustering_.sizes_.leaf);
    former.push_back({id, cluster.anchor, cluster.name, group});
    groups.push_back(std::move(group));
  }
  replace(groups, former);
  if (!fits) form();
}

}  // namespace cairn
