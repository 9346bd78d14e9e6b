// The hierarchies of one landmark graph, one a kind of cost, each made when it is first asked for.
#pragma once

#include <array>
#include <memory>
#include <mutex>

#include "maps/hierarchy/hierarchy.hpp"
#include "maps/hierarchy/route_costs.hpp"

namespace cairn {

class Hierarchies {
 public:
  // The graph must outlive it and be where it is; clusters as in Hierarchy.
  Hierarchies(const LandmarkGraph& graph, ClusterTree clusters, RouteCostRules rules, ClusterRules cluster_rules = {});

  // Thread-safe among its calls. Good until the next update.
  [[nodiscard]] const Hierarchy& by(CostKind kind) const;
  // After the graph has changed; not while another thread reads. When more than costs has changed only the hierarchy
  // by length follows; the others are made anew from its clusters when they are next asked for.
  // Both say whether the clusters may have changed.
  bool update(const GraphChanges& changes);
  bool update();
  // Of all kinds of cost; nothing without such a cluster. Not while another thread reads.
  void name_cluster(ClusterId id, const std::string& name);
  // As of the last update, and nothing is made for it.
  [[nodiscard]] ClusterTree last_tree() const;
  [[nodiscard]] ClusterTree tree() const { return by(CostKind::length).tree(); }

 private:
  template <class Update>
  bool update_all(Update update);

  const LandmarkGraph& graph_;
  ClusterTree clusters_;
  RouteCostRules rules_;
  ClusterRules cluster_rules_;
  mutable std::mutex making_;
  mutable std::array<std::unique_ptr<Hierarchy>, 3> made_;
};

}  // namespace cairn
