// What each cluster is to a search that need not look into it: the exact cost of every way through, from boundary
// vertex to boundary vertex (docs/method.md 9.3; Delling, Goldberg, Pajor, Werneck: Customizable route planning).
//
// The ways of a cluster are found on its inner graph: on level 1 its vertices and arcs, above that the boundary
// vertices of its members with their ways through, and the arcs between members.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "maps/clustering/clustering.hpp"

namespace cairn {

// Of one cluster with B boundary vertices, numbered as in ClusterNode::boundary, and N inner ones.
struct Passage {
  std::vector<double> through;       // [i * B + j]: from i to j without leaving the cluster; kNoRoute: none
  std::vector<double> through_back;  // [j * B + i]: the same, for searches from the goal
  std::vector<std::uint32_t> out_begin, in_begin;  // arcs of boundary vertex i: [begin[i], begin[i + 1])
  std::vector<Arc> out, in;                        // that leave and that enter the cluster

  // For unpacking: inner vertices, member by member (on level 1: its vertices), and the tree of ways from each
  // boundary vertex.
  std::vector<VertexIndex> inner;
  std::vector<std::uint32_t> member_begin;  // members + 1; level 1: empty
  std::vector<std::uint16_t> at;            // boundary vertex -> inner vertex
  std::vector<double> cost;                 // [i * N + n]: from boundary vertex i
  std::vector<std::uint16_t> before;  // [i * N + n]: the inner vertex before n; itself at i and where no way leads

  [[nodiscard]] std::size_t boundary() const { return at.size(); }
  // The number among the members of the one that holds inner vertex n (not for level 1).
  [[nodiscard]] std::size_t member_of(std::size_t n) const;
};

// A route's cost before it changed.
struct CostChange {
  VertexIndex from = kNoVertex;
  VertexIndex to = kNoVertex;
  RouteId route = 0;
  double before = 0.0;
  double after = 0.0;
};

// Follows one network and its clustering, which must be given to every call as they are then.
class Overlay {
 public:
  Overlay() = default;
  // Whether the ways through the clusters of a level are few enough to be worth keeping.
  [[nodiscard]] static bool is_bounded(const Clustering& clustering, int level);

  void build(const Network& network, const Clustering& clustering);  // on all cores
  // After Clustering::follow() with these vertices.
  void follow(const Network& network, const Clustering& clustering, const Clustering::Upkeep& upkeep,
              std::span<const VertexIndex> vertices);
  // After nothing but costs have changed: only ways that used, or would now use, one of the arcs are found anew.
  void recost(const Network& network, const Clustering& clustering, std::span<const CostChange> changes);

  [[nodiscard]] const Passage& passage(ClusterIndex cluster) const { return passages_[cluster]; }
  // As in its ClusterNode, but side by side: a search climbs from level to level at every step.
  [[nodiscard]] ClusterIndex parent_of(ClusterIndex cluster) const { return parents_[cluster]; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct InnerChange {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    double before = 0.0;
    double after = 0.0;
  };
  using InnerChanges = std::map<ClusterIndex, std::vector<InnerChange>>;

  void make(const Network& network, const Clustering& clustering, ClusterIndex cluster);
  void list_inner(const Clustering& clustering, ClusterIndex cluster);
  void list_arcs(const Network& network, const Clustering& clustering, ClusterIndex cluster);
  void take_over(const Clustering& clustering, const CostChange& change, InnerChanges& changes);
  void recost(const Network& network, const Clustering& clustering, ClusterIndex cluster,
              const std::vector<InnerChange>& changes, InnerChanges& above);
  [[nodiscard]] std::uint32_t inner_index(const Clustering& clustering, ClusterIndex cluster, VertexIndex v) const;

  void list_parents(const Clustering& clustering);

  std::vector<Passage> passages_;      // by ClusterIndex
  std::vector<ClusterIndex> parents_;  // by ClusterIndex
};

// Number of v in a rising list that holds it.
[[nodiscard]] std::uint32_t position_of(std::span<const std::uint32_t> rising, std::uint32_t v);

}  // namespace cairn
