#include "maps/hierarchy/hierarchies.hpp"

namespace cairn {

Hierarchies::Hierarchies(const LandmarkGraph& graph, ClusterTree clusters, RouteCostRules rules,
                         ClusterRules cluster_rules)
    : graph_(graph), clusters_(std::move(clusters)), rules_(rules), cluster_rules_(std::move(cluster_rules)) {}

// All kinds have the clusters of the first, so that names mean the same.
const Hierarchy& Hierarchies::by(CostKind kind) const {
  const std::scoped_lock lock(making_);
  const auto make = [&](CostKind of, const ClusterTree& clusters) -> const Hierarchy& {
    std::unique_ptr<Hierarchy>& hierarchy = made_[static_cast<std::size_t>(of)];
    if (hierarchy == nullptr)
      hierarchy = std::make_unique<Hierarchy>(graph_, clusters, route_cost(of, rules_), cluster_rules_);
    return *hierarchy;
  };
  const Hierarchy& by_length = make(CostKind::length, clusters_);
  return kind == CostKind::length ? by_length : make(kind, by_length.tree());
}

ClusterTree Hierarchies::last_tree() const {
  const std::scoped_lock lock(making_);
  const std::unique_ptr<Hierarchy>& by_length = made_[static_cast<std::size_t>(CostKind::length)];
  return by_length == nullptr ? clusters_ : by_length->tree();
}

void Hierarchies::name_cluster(ClusterId id, const std::string& name) {
  const std::scoped_lock lock(making_);
  if (const auto found = clusters_.clusters.find(id); found != clusters_.clusters.end()) found->second.name = name;
  for (const std::unique_ptr<Hierarchy>& hierarchy : made_)
    if (hierarchy != nullptr) hierarchy->name_cluster(id, name);
}

// Each on its own would cut its clusters by its own costs, and names would no longer mean the same.
template <class Update>
bool Hierarchies::update_all(Update update) {
  const std::unique_ptr<Hierarchy>& by_length = made_[static_cast<std::size_t>(CostKind::length)];
  if (by_length == nullptr) return false;
  const bool only_costs = !update(*by_length);
  for (std::unique_ptr<Hierarchy>& hierarchy : made_) {
    if (hierarchy == nullptr || hierarchy == by_length) continue;
    if (only_costs)
      update(*hierarchy);
    else
      hierarchy.reset();
  }
  return !only_costs;
}

bool Hierarchies::update(const GraphChanges& changes) {
  return update_all([&](Hierarchy& hierarchy) { return hierarchy.update(graph_, changes); });
}

bool Hierarchies::update() {
  return update_all([&](Hierarchy& hierarchy) { return hierarchy.update(graph_); });
}

}  // namespace cairn
