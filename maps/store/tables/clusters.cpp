#include <algorithm>
#include <set>

#include "maps/store/tables/reading.hpp"
#include "maps/store/tables/tables.hpp"

namespace cairn::store {
namespace {

constexpr std::int64_t kMaxClusterLevel = 64;

// A parent is one level higher, so no cluster is its own ancestor.
void check_parent(const Cluster& cluster, const ClusterTree& tree, int highest) {
  const std::string what = numbered("cluster", cluster.id);
  if (cluster.parent == 0) {
    if (cluster.level == highest) return;
    throw StoreError(what + " of level " + std::to_string(cluster.level) + " has no parent, the highest level is " +
                     std::to_string(highest));
  }
  const auto parent = tree.clusters.find(cluster.parent);
  if (parent == tree.clusters.end()) throw StoreError(what + ": there is no " + numbered("cluster", cluster.parent));
  if (parent->second.level != cluster.level + 1)
    throw StoreError(what + " of level " + std::to_string(cluster.level) + " has a parent of level " +
                     std::to_string(parent->second.level));
}

void check_cluster(const Cluster& cluster, const SavedMap& map) {
  const std::string what = numbered("cluster", cluster.id);
  if (map.graph.find(cluster.anchor) == nullptr)
    throw StoreError(what + ": there is no " + numbered("landmark", cluster.anchor));
  if (cluster.id >= map.clusters.next_id)
    throw StoreError(what + " is not below the next id, " + std::to_string(map.clusters.next_id));
}

}  // namespace

void read_clusters(Database& database, SavedMap& map) {
  ClusterTree& tree = map.clusters;
  int highest = 0;
  Statement row(database, "SELECT id, level, parent, anchor, name FROM clusters ORDER BY id");
  while (row.step()) {
    Cluster cluster{row.integer_within(0, 1, kMaxId), static_cast<int>(row.integer_within(1, 1, kMaxClusterLevel)),
                    row.integer_within(2, 0, kMaxId), row.integer(3), row.plain_text(4)};
    check_cluster(cluster, map);
    highest = std::max(highest, cluster.level);
    tree.clusters.emplace(cluster.id, std::move(cluster));
  }
  std::set<ClusterId> parents;
  for (const auto& [id, cluster] : tree.clusters) {
    check_parent(cluster, tree, highest);
    parents.insert(cluster.parent);
  }
  for (const auto& [id, cluster] : tree.clusters)
    if (cluster.level > 1 && !parents.contains(id)) throw StoreError(numbered("cluster", id) + " holds no cluster");
}

void read_landmark_clusters(Database& database, SavedMap& map) {
  ClusterTree& tree = map.clusters;
  std::set<ClusterId> empty;
  for (const auto& [id, cluster] : tree.clusters)
    if (cluster.level == 1) empty.insert(id);
  Statement row(database, "SELECT landmark, cluster FROM landmark_clusters ORDER BY landmark");
  while (row.step()) {
    const LandmarkId landmark = row.integer(0);
    const auto cluster = tree.clusters.find(row.integer(1));
    if (map.graph.find(landmark) == nullptr) throw StoreError("there is no " + numbered("landmark", landmark));
    if (cluster == tree.clusters.end()) throw StoreError("there is no " + numbered("cluster", row.integer(1)));
    if (cluster->second.level != 1)
      throw StoreError(numbered("landmark", landmark) + " is in " + numbered("cluster", cluster->first) + " of level " +
                       std::to_string(cluster->second.level) + ", landmarks are in clusters of level 1");
    empty.erase(cluster->first);
    tree.cluster_of.emplace_hint(tree.cluster_of.end(), landmark, cluster->first);
  }
  if (!empty.empty()) throw StoreError(numbered("cluster", *empty.begin()) + " holds no landmark");
  const std::size_t landmarks = map.graph.landmarks().size();
  if (!tree.cluster_of.empty() && tree.cluster_of.size() != landmarks)
    throw StoreError("only " + std::to_string(tree.cluster_of.size()) + " of " + std::to_string(landmarks) +
                     " landmarks are in a cluster");
}

}  // namespace cairn::store
