#include "tests/maps/hierarchy/graph_laws.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>
#include <tuple>

namespace cairn::test {
namespace {

using Entry = std::pair<double, std::uint64_t>;
using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

std::string named(const ClusterNode& node) {
  return "cluster " + std::to_string(node.id) + " of level " + std::to_string(node.level);
}

// All vertices of each cluster, found from below.
std::map<ClusterIndex, std::vector<VertexIndex>> vertices_of(const Clustering& clustering, const Network& network) {
  std::map<ClusterIndex, std::vector<VertexIndex>> vertices;
  for (VertexIndex v = 0; v < network.end(); ++v)
    for (int level = 1; network.landmark_of(v) != 0 && level <= clustering.levels(); ++level)
      vertices[clustering.cluster_of(v, level)].push_back(v);
  return vertices;
}

template <class Visit>
void for_each_neighbour(const Network& network, VertexIndex v, Visit visit) {
  for (const auto* arcs : {&network.out(v), &network.in(v)})
    for (const Arc& arc : *arcs) visit(arc.other);
}

std::size_t reached_inside(const Network& network, const std::set<VertexIndex>& inside) {
  std::set<VertexIndex> seen{*inside.begin()};
  std::vector<VertexIndex> waiting{*inside.begin()};
  while (!waiting.empty()) {
    const VertexIndex v = waiting.back();
    waiting.pop_back();
    for_each_neighbour(network, v, [&](VertexIndex other) {
      if (inside.contains(other) && seen.insert(other).second) waiting.push_back(other);
    });
  }
  return seen.size();
}

std::vector<std::uint32_t> members_of(const ClusterNode& node, const Clustering& clustering,
                                      const std::vector<VertexIndex>& vertices) {
  if (node.level == 1) return vertices;
  std::set<std::uint32_t> members;
  for (const VertexIndex v : vertices) members.insert(clustering.cluster_of(v, node.level - 1));
  return {members.begin(), members.end()};
}

std::string broken_law_of(ClusterIndex cluster, const std::vector<VertexIndex>& vertices, const Clustering& clustering,
                          const Network& network) {
  const ClusterNode& node = clustering.node(cluster);
  const std::set<VertexIndex> inside(vertices.begin(), vertices.end());
  std::vector<VertexIndex> boundary;
  for (const VertexIndex v : vertices) {
    bool leads_out = false;
    for_each_neighbour(network, v, [&](VertexIndex other) { leads_out = leads_out || !inside.contains(other); });
    if (leads_out) boundary.push_back(v);
  }
  const VertexIndex anchor = network.vertex_of(node.anchor);
  if (node.members != members_of(node, clustering, vertices)) return named(node) + " does not know its members";
  if (static_cast<std::size_t>(node.landmarks) != vertices.size()) return named(node) + " miscounts its landmarks";
  if (node.landmarks > clustering.sizes().most(node.level)) return named(node) + " is too large";
  if (reached_inside(network, inside) != vertices.size()) return named(node) + " is not connected";
  if (node.boundary != boundary) return named(node) + " has another boundary";
  if (anchor == kNoVertex || !inside.contains(anchor)) return named(node) + " has a foreign anchor";
  if ((node.parent == kNoCluster) != (node.level == clustering.levels())) return named(node) + " has a wrong parent";
  return {};
}

std::vector<double> costs_inside(VertexIndex from, ClusterIndex cluster, int level, const Hierarchy& hierarchy) {
  const Network& network = hierarchy.network();
  std::vector<double> cost(network.end(), kNoRoute);
  cost[from] = 0.0;
  Queue queue;
  queue.emplace(0.0, from);
  while (!queue.empty()) {
    const auto [reached, v] = queue.top();
    queue.pop();
    if (reached > cost[v]) continue;
    for (const Arc& arc : network.out(static_cast<VertexIndex>(v))) {
      if (hierarchy.clustering().cluster_of(arc.other, level) != cluster) continue;
      if (!(reached + arc.cost < cost[arc.other])) continue;
      cost[arc.other] = reached + arc.cost;
      queue.emplace(cost[arc.other], arc.other);
    }
  }
  return cost;
}

bool same_cost(double a, double b) {
  return a == b || std::abs(a - b) <= 1e-9 * std::max(1.0, std::abs(a));
}

using ArcTuple = std::tuple<VertexIndex, VertexIndex, RouteId, double>;

}  // namespace

LandmarkId GraphChanger::any_landmark() {
  if (graph_.landmarks().empty()) return 0;
  const auto id = static_cast<LandmarkId>(random_() % static_cast<std::uint64_t>(graph_.next_landmark_id()));
  const auto at = graph_.landmarks().lower_bound(id);
  return at == graph_.landmarks().end() ? graph_.landmarks().begin()->first : at->first;
}

RouteId GraphChanger::any_route() {
  if (graph_.routes().empty()) return 0;
  const auto id = static_cast<RouteId>(random_() % static_cast<std::uint64_t>(graph_.next_route_id()));
  const auto at = graph_.routes().lower_bound(id);
  return at == graph_.routes().end() ? graph_.routes().begin()->first : at->first;
}

LandmarkId GraphChanger::near(LandmarkId id) {
  for (std::size_t hops = random_() % 4; hops > 0; --hops) {
    const bool onwards = random_() % 2 == 0;
    const std::vector<RouteId>& routes = onwards ? graph_.routes_from(id) : graph_.routes_to(id);
    if (routes.empty()) continue;
    const Route& route = *graph_.find_route(routes[random_() % routes.size()]);
    id = onwards ? route.to : route.from;
  }
  return id;
}

double GraphChanger::any_cost() {
  const std::uint64_t kind = random_() % 10;
  if (kind == 0) return 0.0;
  return kind < 4 ? static_cast<double>(1 + random_() % 5) : static_cast<double>(random_() % 100000) / 1000.0;
}

void GraphChanger::add_route(LandmarkId from, LandmarkId to, GraphChanges& changes) {
  Route route;
  route.from = from;
  route.to = to;
  route.cost_m = any_cost();
  route.closed = random_() % 12 == 0;
  changes.routes.push_back(graph_.add_route(route));
  if (random_() % 5 == 0) return;
  std::swap(route.from, route.to);
  changes.routes.push_back(graph_.add_route(route));
}

void GraphChanger::add_landmark(GraphChanges& changes) {
  const LandmarkId beside = any_landmark();
  const LandmarkId id = graph_.add({});
  changes.landmarks.push_back(id);
  if (beside == 0 || random_() % 40 == 0) return;
  add_route(id, beside, changes);
  for (std::size_t more = random_() % 3; more > 0; --more) add_route(id, near(beside), changes);
}

GraphChanges GraphChanger::change(double growth) {
  GraphChanges changes;
  const std::uint64_t kind = random_() % 10;
  const LandmarkId landmark = any_landmark();
  const RouteId route = any_route();
  if (landmark == 0 || route == 0 || kind < 4) {
    if (landmark == 0 || static_cast<double>(random_() % 1000) < 1000.0 * growth) {
      add_landmark(changes);
    } else {
      changes.landmarks.push_back(landmark);
      graph_.remove(landmark);
    }
  } else if (kind == 4) {
    add_route(landmark, random_() % 8 == 0 ? any_landmark() : near(landmark), changes);
  } else {
    changes.routes.push_back(route);
    if (kind == 5)
      graph_.remove_route(route);
    else if (kind < 8)
      graph_.set_cost(route, any_cost());
    else
      graph_.set_closed(route, !graph_.find_route(route)->closed);
  }
  return changes;
}

GraphChanges GraphChanger::batch(int changes, double growth) {
  GraphChanges all;
  for (; changes > 0; --changes) {
    const GraphChanges more = change(growth);
    all.landmarks.insert(all.landmarks.end(), more.landmarks.begin(), more.landmarks.end());
    all.routes.insert(all.routes.end(), more.routes.begin(), more.routes.end());
  }
  return all;
}

void GraphChanger::grow_to(std::size_t landmarks) {
  GraphChanges changes;
  while (graph_.landmarks().size() < landmarks) add_landmark(changes);
}

LandmarkGraph random_graph(std::size_t landmarks, std::uint64_t seed) {
  LandmarkGraph graph;
  GraphChanger(graph, seed).grow_to(landmarks);
  return graph;
}

std::map<LandmarkId, double> costs_from(const LandmarkGraph& graph, const std::map<LandmarkId, double>& from,
                                        const RouteCost& cost) {
  std::map<LandmarkId, double> costs = from;
  Queue queue;
  for (const auto& [id, reached] : from) queue.emplace(reached, id);
  while (!queue.empty()) {
    const auto [reached, id] = queue.top();
    queue.pop();
    if (reached > costs.at(static_cast<LandmarkId>(id))) continue;
    for (const RouteId r : graph.routes_from(static_cast<LandmarkId>(id))) {
      const Route& route = *graph.find_route(r);
      if (route.closed) continue;
      const double next = reached + cost(route);
      const auto [at, fresh] = costs.emplace(route.to, next);
      if (!fresh && !(next < at->second)) continue;
      at->second = next;
      queue.emplace(next, route.to);
    }
  }
  return costs;
}

std::string broken_law(const Clustering& clustering, const Network& network) {
  const auto vertices = vertices_of(clustering, network);
  if (vertices.contains(kNoCluster)) return "a vertex has no cluster";
  std::set<ClusterId> ids;
  for (ClusterIndex c = 0; c < clustering.end(); ++c) {
    const ClusterNode& node = clustering.node(c);
    if (node.level == 0) continue;
    if (!vertices.contains(c)) return named(node) + " is empty";
    if (node.id <= 0 || !ids.insert(node.id).second) return named(node) + " shares its id";
    if (const std::string law = broken_law_of(c, vertices.at(c), clustering, network); !law.empty()) return law;
  }
  for (VertexIndex v = 0; v < network.end(); ++v)
    if (network.landmark_of(v) == 0 && clustering.leaf_of(v) != kNoCluster) return "a free number has a cluster";
  return {};
}

std::string broken_way(const Hierarchy& hierarchy) {
  const Clustering& clustering = hierarchy.clustering();
  for (ClusterIndex c = 0; c < clustering.end(); ++c) {
    const ClusterNode& node = clustering.node(c);
    if (node.level == 0) continue;
    const Passage& passage = hierarchy.overlay().passage(c);
    const std::size_t count = node.boundary.size();
    if (passage.boundary() != count || passage.through.size() != count * count) return named(node) + " is outdated";
    for (std::size_t i = 0; i < count; ++i) {
      const std::vector<double> costs = costs_inside(node.boundary[i], c, node.level, hierarchy);
      for (std::size_t j = 0; j < count; ++j) {
        const double want = costs[node.boundary[j]];
        if (!same_cost(want, passage.through[i * count + j]) || !same_cost(want, passage.through_back[j * count + i]))
          return named(node) + ": from its boundary vertex " + std::to_string(i) + " to " + std::to_string(j) + " " +
                 std::to_string(passage.through[i * count + j]) + " instead of " + std::to_string(want);
      }
    }
  }
  return {};
}

std::string broken_network(const Network& network, const LandmarkGraph& graph, const RouteCost& cost) {
  std::set<ArcTuple> wanted;
  for (const auto& [id, route] : graph.routes())
    if (route.from != route.to)
      wanted.emplace(network.vertex_of(route.from), network.vertex_of(route.to), id,
                     route.closed ? kNoRoute : cost(route));
  std::set<ArcTuple> out;
  std::set<ArcTuple> in;
  std::size_t arcs = 0;
  std::size_t landmarks = 0;
  for (VertexIndex v = 0; v < network.end(); ++v) {
    arcs += network.out(v).size() + network.in(v).size();
    for (const Arc& arc : network.out(v)) out.emplace(v, arc.other, arc.route, arc.cost);
    for (const Arc& arc : network.in(v)) in.emplace(arc.other, v, arc.route, arc.cost);
    if (network.landmark_of(v) == 0) continue;
    ++landmarks;
    if (network.vertex_of(network.landmark_of(v)) != v) return "a landmark has another number than its vertex";
    if (graph.find(network.landmark_of(v)) == nullptr) return "a vertex has no landmark";
  }
  if (landmarks != graph.landmarks().size() || network.landmarks() != landmarks) return "landmarks are missing";
  if (out != wanted || in != wanted || arcs != 2 * wanted.size()) return "arcs are not the routes";
  for (const auto& [from, to, route, value] : wanted)
    if (network.ends_of(route) != std::pair(from, to)) return "a route has other ends";
  return {};
}

std::string drawn_tree(const ClusterTree& tree) {
  std::string text = "next " + std::to_string(tree.next_id) + "\n";
  for (const auto& [id, cluster] : tree.clusters) {
    text += std::to_string(id) + " of level " + std::to_string(cluster.level) + " in " +
            std::to_string(cluster.parent) + ", after L" + std::to_string(cluster.anchor) + " (" + cluster.name + "):";
    for (const auto& [landmark, leaf] : tree.cluster_of)
      if (leaf == id) text += " L" + std::to_string(landmark);
    text += "\n";
  }
  return text;
}

}  // namespace cairn::test
