// The clusters of a landmark graph, as names and numbers: what a saved map keeps of the hierarchy (docs/method.md 9.2).
//
// Level 1 clusters hold landmarks, clusters of level l + 1 hold clusters of level l. Every cluster is connected
// by routes, open or closed. A landmark belongs to one cluster of each level.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

using ClusterId = std::int64_t;

struct Cluster {
  ClusterId id = 0;  // never given twice
  int level = 1;
  ClusterId parent = 0;   // 0: it is on the highest level
  LandmarkId anchor = 0;  // the landmark it is named after
  std::string name;       // given by the user; may be empty: "C<level>:<label of the anchor>" always names it too
  bool operator==(const Cluster&) const = default;
};

struct ClusterTree {
  std::map<ClusterId, Cluster> clusters;
  std::map<LandmarkId, ClusterId> cluster_of;  // of level 1; all landmarks, or none at all where they are few
  ClusterId next_id = 1;
  bool operator==(const ClusterTree&) const = default;
};

// What the user named it, else "C<level>:<label of its anchor>".
[[nodiscard]] std::string label_of(const Cluster& cluster, const LandmarkGraph& graph);
// By its own name, which wins, by "C<level>:<label>" or by "C<level>:L<anchor>"; the lower id of namesakes. Null: there
// is none.
[[nodiscard]] const Cluster* find_cluster(const ClusterTree& tree, const LandmarkGraph& graph,
                                          const std::string& label);
// The landmarks of a cluster of any level, rising. O(landmarks).
[[nodiscard]] std::vector<LandmarkId> members_of(const ClusterTree& tree, ClusterId cluster);

struct ListedCluster {
  Cluster cluster;
  std::string label;
  std::vector<LandmarkId> landmarks;  // rising
  bool operator==(const ListedCluster&) const = default;
};
// All clusters by rising id. O(landmarks * levels).
[[nodiscard]] std::vector<ListedCluster> listed(const ClusterTree& tree, const LandmarkGraph& graph);

// Whether it is, or begins like, what Cairn calls things by itself: "L17", "C2:...". No user's name should.
[[nodiscard]] bool looks_like_id(std::string_view name);

}  // namespace cairn
