// A landmark graph ready for exact searches at any size: its network, its clusters and what they are to searches
// that pass them (docs/method.md 9.3).
//
// Belongs to one landmark graph, which reports its changes by update(). Reading is thread-safe, updating is not.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"
#include "maps/hierarchy/overlay.hpp"
#include "maps/hierarchy/straight_bound.hpp"

namespace cairn {

// What has been added, changed or removed in a landmark graph. What is named needlessly does no harm.
struct GraphChanges {
  std::vector<LandmarkId> landmarks;
  std::vector<RouteId> routes;
};

// The width of the narrowest place of a route, m; none: it is not known.
using PassageWidth = std::function<std::optional<double>(const Route&)>;
// In this grid and between these landmarks, which are no walls; both must outlive it; a route without a trajectory has
// none, and so has any where the grid is empty. Wider passages than max_m count as that wide.
[[nodiscard]] PassageWidth passages_in(const OccupancyGrid& grid, const LandmarkGraph& graph, double max_m);

// How a graph is clustered.
struct ClusterRules {
  ClusterRules(const ClusterSizes& of_sizes = {}, PassageWidth of_width = {})  // NOLINT: sizes are rules
      : sizes(of_sizes), width(std::move(of_width)) {}

  ClusterSizes sizes;
  PassageWidth width;  // none: by the costs of routes alone. Asked when clusters of a small graph are formed
};

class Hierarchy {
 public:
  // O(n log n) for what people build; clusters as saved, or anew when the tree is empty. Throws
  // std::invalid_argument when the cost of a route is negative or not finite.
  explicit Hierarchy(const LandmarkGraph& graph, const ClusterTree& clusters = {}, RouteCost cost = cost_by_length,
                     ClusterRules rules = {});
  // Clustered anew, by other means than METIS.
  Hierarchy(const LandmarkGraph& graph, const ClusterSizes& sizes, const Proposal& propose);

  // Brings it in line with the graph. When only costs have changed (also by closing and opening), only ways that
  // used, or would now use, these routes are found anew; otherwise the clusters that hold a change. Says whether more
  // than costs has changed, and the clusters may have.
  bool update(const LandmarkGraph& graph, const GraphChanges& changes);
  // The same, for who does not know what has changed: looks at everything.
  bool update(const LandmarkGraph& graph);

  void name_cluster(ClusterId id, const std::string& name);  // nothing without such a cluster

  [[nodiscard]] const Network& network() const { return network_; }
  [[nodiscard]] const Clustering& clustering() const { return clustering_; }
  [[nodiscard]] const Overlay& overlay() const { return overlay_; }
  [[nodiscard]] const StraightBound& bound() const { return bound_; }
  [[nodiscard]] int levels() const { return clustering_.levels(); }
  [[nodiscard]] ClusterTree tree() const { return clustering_.tree(network_); }

 private:
  struct NetworkChanges {
    std::vector<VertexIndex> moved;  // new, gone, or with other arcs
    std::vector<CostChange> costs;
  };
  NetworkChanges sync_network(const LandmarkGraph& graph, const GraphChanges& changes);
  void sync_route(const LandmarkGraph& graph, RouteId id, NetworkChanges& synced);

  RouteCost cost_;
  ClusterRules rules_;
  Network network_;
  StraightBound bound_;
  Clustering clustering_;
  Overlay overlay_;
};

// The clusters that a hierarchy of the graph would have, without the ways through them.
[[nodiscard]] ClusterTree cluster_landmarks(const LandmarkGraph& graph, const ClusterTree& clusters = {},
                                            const ClusterRules& rules = {});

}  // namespace cairn
