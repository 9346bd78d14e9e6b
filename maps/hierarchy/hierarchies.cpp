#include "maps/hierarchy/hierarchies.hpp"

namespace cairn {

Hierarchies::Hierarchies(const LandmarkGraph& graph, ClusterTree clusters, RouteCostRules rules)
    : graph_(graph), clusters_(std::move(clusters)), rules_(std::move(rules)) {}

// All kinds have the clusters of the first, so that names mean the same.
const Hierarchy& Hierarchies::by(CostKind kind) const {
  const std::scoped_lock lock(making_);
  const auto make = [&](CostKind of, const ClusterTree& clusters) -> const Hierarchy& {
    std::unique_ptr<Hierarchy>& hierarchy = made_[static_cast<std::size_t>(of)];
    if (hierarchy == nullptr) hierarchy = std::make_unique<Hierarchy>(graph_, clusters, route_cost(of, rules_));
    return *hierarchy;
  };
  const Hierarchy& by_length = make(CostKind::length, clusters_);
  return kind == CostKind::length ? by_length : make(kind, by_length.tree());
}

void Hierarchies::update(const GraphChanges& changes) {
  for (const auto& hierarchy : made_)
    if (hierarchy != nullptr) hierarchy->update(graph_, changes);
}

void Hierarchies::update() {
  for (const auto& hierarchy : made_)
    if (hierarchy != nullptr) hierarchy->update(graph_);
}

}  // namespace cairn
