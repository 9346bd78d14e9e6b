// Random landmark graphs, random changes of them, and what must hold of a hierarchy over them.
#pragma once

#include <map>
#include <random>
#include <string>
#include <vector>

#include "maps/hierarchy/hierarchy.hpp"

namespace cairn::test {

// Changes a landmark graph at random and says what it has changed. Routes are mostly short hops between landmarks
// near each other; one-way, parallel, closed and free ones, routes that lead back to where they begin, and parts that
// no route joins come about too.
class GraphChanger {
 public:
  GraphChanger(LandmarkGraph& graph, std::uint64_t seed) : graph_(graph), random_(seed) {}

  // Adds landmarks until there are so many.
  void grow_to(std::size_t landmarks);
  // One change. `growth`: the share of landmark changes that add one.
  GraphChanges change(double growth = 0.5);
  // Some changes as one; what came and went meanwhile is named too.
  GraphChanges batch(int changes, double growth = 0.5);
  [[nodiscard]] LandmarkId any_landmark();  // 0: there is none
  [[nodiscard]] std::size_t number_below(std::size_t end) { return random_() % end; }

 private:
  [[nodiscard]] LandmarkId near(LandmarkId id);
  [[nodiscard]] RouteId any_route();
  [[nodiscard]] double any_cost();
  void add_landmark(GraphChanges& changes);
  void add_route(LandmarkId from, LandmarkId to, GraphChanges& changes);

  LandmarkGraph& graph_;
  std::mt19937_64 random_;
};

[[nodiscard]] LandmarkGraph random_graph(std::size_t landmarks, std::uint64_t seed);

// What the cheapest route from some landmarks to each one costs, by Dijkstra over the graph itself; without those that
// no open route leads to. `from`: with what each costs to get to.
[[nodiscard]] std::map<LandmarkId, double> costs_from(const LandmarkGraph& graph,
                                                      const std::map<LandmarkId, double>& from,
                                                      const RouteCost& cost = cost_by_length);

// The first law that the clusters break, or nothing: a vertex is in one cluster a level; every cluster is connected,
// not empty and within bounds, knows its members, its boundary as defined, and an anchor among them; ids are unique.
[[nodiscard]] std::string broken_law(const Clustering& clustering, const Network& network);
// The same of a route through a cluster whose cost is not that of Dijkstra inside the cluster.
[[nodiscard]] std::string broken_way(const Hierarchy& hierarchy);
// The same of a network that is not its graph.
[[nodiscard]] std::string broken_network(const Network& network, const LandmarkGraph& graph, const RouteCost& cost);

// A cluster a line: "12 of level 1 in 17, after L4 (name): L3 L4 L8".
[[nodiscard]] std::string drawn_tree(const ClusterTree& tree);

}  // namespace cairn::test
