#include "maps/hierarchy/hierarchy.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "maps/clustering/passage_width.hpp"

namespace cairn {
namespace {

std::optional<double> cost_in(const Network& network, RouteId id) {
  const auto [from, to] = network.ends_of(id);
  if (from == kNoVertex) return std::nullopt;
  for (const Arc& arc : network.out(from))
    if (arc.route == id) return arc.cost;
  return std::nullopt;
}

// Routes of a landmark that is gone, or new, are changes too.
std::set<RouteId> routes_of(const GraphChanges& changes, const LandmarkGraph& graph, const Network& network) {
  std::set<RouteId> routes(changes.routes.begin(), changes.routes.end());
  for (const LandmarkId id : changes.landmarks) {
    for (const auto* touching : {&graph.routes_from(id), &graph.routes_to(id)})
      routes.insert(touching->begin(), touching->end());
    if (const VertexIndex v = network.vertex_of(id); v != kNoVertex)
      for (const auto* arcs : {&network.out(v), &network.in(v)})
        for (const Arc& arc : *arcs) routes.insert(arc.route);
  }
  return routes;
}

// Levels whose clusters have so many ways through that keeping them gains nothing.
void drop_needless_levels(Clustering& clustering) {
  if (clustering.is_small()) return;  // not searches need its clusters, people do
  for (int level = 1; level <= clustering.levels(); ++level)
    if (!Overlay::is_bounded(clustering, level))
      while (clustering.levels() >= level) clustering.drop_level();
}

PassageWidths widths_of(const LandmarkGraph& graph, const PassageWidth& width) {
  if (!width) return {};
  return [&](RouteId id) { return width(*graph.find_route(id)); };
}

}  // namespace

PassageWidth passages_in(const OccupancyGrid& grid, const LandmarkGraph& graph, double max_m) {
  return [&grid, &graph, max_m](const Route& route) -> std::optional<double> {
    if (route.trajectory.size() < 2 || grid.bounds().empty()) return std::nullopt;
    std::vector<Point> landmarks_m;
    for (const auto& [id, landmark] : graph.landmarks()) landmarks_m.push_back(landmark.T_map_landmark.position());
    return passage_width_m(route.trajectory, grid, landmarks_m, max_m);
  };
}

ClusterTree cluster_landmarks(const LandmarkGraph& graph, const ClusterTree& clusters, const ClusterRules& rules) {
  const Network network(graph, cost_by_length);
  Clustering clustering(network, rules.sizes, clusters, widths_of(graph, rules.width));
  drop_needless_levels(clustering);
  return clustering.tree(network);
}

Hierarchy::Hierarchy(const LandmarkGraph& graph, const ClusterTree& clusters, RouteCost cost, ClusterRules rules)
    : cost_(std::move(cost)),
      rules_(std::move(rules)),
      network_(graph, cost_),
      bound_(graph, network_),
      clustering_(network_, rules_.sizes, clusters, widths_of(graph, rules_.width)) {
  drop_needless_levels(clustering_);
  overlay_.build(network_, clustering_);
}

Hierarchy::Hierarchy(const LandmarkGraph& graph, const ClusterSizes& sizes, const Proposal& propose)
    : cost_(cost_by_length),
      rules_{sizes, {}},
      network_(graph, cost_),
      bound_(graph, network_),
      clustering_(network_, sizes, propose) {
  drop_needless_levels(clustering_);
  overlay_.build(network_, clustering_);
}

// New landmarks come before their routes, and removed ones go after theirs.
Hierarchy::NetworkChanges Hierarchy::sync_network(const LandmarkGraph& graph, const GraphChanges& changes) {
  NetworkChanges synced;
  const std::set<RouteId> routes = routes_of(changes, graph, network_);
  std::set<LandmarkId> landmarks(changes.landmarks.begin(), changes.landmarks.end());
  for (const RouteId id : routes)
    if (const Route* const route = graph.find_route(id)) landmarks.insert({route->from, route->to});
  for (const LandmarkId id : landmarks)
    if (graph.find(id) != nullptr && network_.vertex_of(id) == kNoVertex) {
      network_.sync_landmark(graph, id);
      synced.moved.push_back(network_.vertex_of(id));
      bound_.set_place(graph, network_, network_.vertex_of(id));
    }
  for (const LandmarkId id : changes.landmarks)
    if (const VertexIndex v = network_.vertex_of(id); v != kNoVertex) bound_.set_place(graph, network_, v);
  for (const RouteId id : routes) {
    sync_route(graph, id, synced);
    bound_.add_route(network_, id);
  }
  for (const LandmarkId id : landmarks)
    if (const VertexIndex v = network_.vertex_of(id); v != kNoVertex && graph.find(id) == nullptr) {
      network_.sync_landmark(graph, id);
      synced.moved.push_back(v);
    }
  return synced;
}

void Hierarchy::sync_route(const LandmarkGraph& graph, RouteId id, NetworkChanges& synced) {
  const auto ends = network_.ends_of(id);
  const std::optional<double> before = cost_in(network_, id);
  network_.sync_route(graph, id, cost_);
  const std::optional<double> after = cost_in(network_, id);
  const auto note_ends = [&](std::pair<VertexIndex, VertexIndex> moved) {
    if (moved.first != kNoVertex) synced.moved.insert(synced.moved.end(), {moved.first, moved.second});
  };
  if (network_.ends_of(id) != ends || before.has_value() != after.has_value()) {
    note_ends(ends);
    note_ends(network_.ends_of(id));
  } else if (before != after) {
    synced.costs.push_back({ends.first, ends.second, id, *before, *after});
  }
}

void Hierarchy::name_cluster(ClusterId id, const std::string& name) {
  for (ClusterIndex c = 0; c < clustering_.end(); ++c)
    if (clustering_.node(c).level > 0 && clustering_.node(c).id == id) clustering_.set_name(c, name);
}

bool Hierarchy::update(const LandmarkGraph& graph, const GraphChanges& changes) {
  auto [moved, costs] = sync_network(graph, changes);
  if (moved.empty()) {
    overlay_.recost(network_, clustering_, costs);
    return false;
  }
  for (const CostChange& change : costs) moved.insert(moved.end(), {change.from, change.to});
  std::sort(moved.begin(), moved.end());
  moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
  Clustering::Upkeep upkeep = clustering_.follow(network_, moved, widths_of(graph, rules_.width));
  const int levels = clustering_.levels();
  drop_needless_levels(clustering_);
  upkeep.levels_changed = upkeep.levels_changed || clustering_.levels() != levels;
  overlay_.follow(network_, clustering_, upkeep, moved);
  return true;
}

bool Hierarchy::update(const LandmarkGraph& graph) {
  GraphChanges changes;
  for (const auto& [id, landmark] : graph.landmarks()) changes.landmarks.push_back(id);
  for (VertexIndex v = 0; v < network_.end(); ++v)
    if (network_.landmark_of(v) != 0) changes.landmarks.push_back(network_.landmark_of(v));
  return update(graph, changes);
}

}  // namespace cairn
