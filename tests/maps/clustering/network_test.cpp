#include "maps/clustering/network.hpp"

#include <gtest/gtest.h>

#include "tests/maps/drawn_graph.hpp"
#include "tests/maps/hierarchy/graph_laws.hpp"

namespace cairn {
namespace {

using test::broken_network;

Route route_of(LandmarkId from, LandmarkId to, double cost_m) {
  Route route;
  route.from = from;
  route.to = to;
  route.cost_m = cost_m;
  return route;
}

TEST(Network, HoldsTheGraph) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const LandmarkGraph graph = test::random_graph(10 * seed, seed);
    EXPECT_EQ(broken_network(Network(graph, cost_by_length), graph, cost_by_length), "") << "seed " << seed;
  }
}

TEST(Network, FollowsTheGraphRouteByRoute) {
  LandmarkGraph graph = drawn_graph("1<>2 2<>3");
  Network network(graph, cost_by_length);
  const RouteId fresh = graph.add_route(route_of(1, 3, 2.5));
  network.sync_route(graph, fresh, cost_by_length);
  EXPECT_EQ(broken_network(network, graph, cost_by_length), "");
  graph.set_cost(fresh, 0.0);
  graph.set_closed(1, true);
  network.sync_route(graph, fresh, cost_by_length);
  network.sync_route(graph, 1, cost_by_length);
  EXPECT_EQ(broken_network(network, graph, cost_by_length), "");
  EXPECT_EQ(network.cheapest(network.vertex_of(1), network.vertex_of(2)), nullptr);
  graph.remove_route(fresh);
  network.sync_route(graph, fresh, cost_by_length);
  network.sync_route(graph, fresh, cost_by_length);
  EXPECT_EQ(broken_network(network, graph, cost_by_length), "") << "and once more does no harm";
}

TEST(Network, RoutesThatLeadBackToWhereTheyBeginAreLeftOut) {
  LandmarkGraph graph = drawn_graph("1<>2");
  graph.add_route(route_of(1, 1, 3.0));
  Network network(graph, cost_by_length);
  EXPECT_EQ(broken_network(network, graph, cost_by_length), "");
  EXPECT_EQ(network.ends_of(3).first, kNoVertex);
  Route bent = route_of(2, 2, 1.0);
  bent.id = 1;
  graph.remove_route(1);
  graph.add_route(bent);
  network.sync_route(graph, 1, cost_by_length);
  EXPECT_EQ(broken_network(network, graph, cost_by_length), "") << "one that has become such";
}

TEST(Network, OfParallelRoutesTheCheapestOpenOneIsTakenTheLowerOfEqualOnes) {
  LandmarkGraph graph = drawn_graph("1>2 1>2 1>2 1>2");
  graph.set_cost(1, 5.0);
  graph.set_cost(2, 0.5);
  graph.set_closed(2, true);
  const Network network(graph, cost_by_length);
  EXPECT_EQ(network.cheapest(network.vertex_of(1), network.vertex_of(2))->route, 3);
  EXPECT_EQ(network.cheapest(network.vertex_of(2), network.vertex_of(1)), nullptr);
}

TEST(Network, GivesTheNumbersOfRemovedLandmarksAgain) {
  LandmarkGraph graph = drawn_graph("1<>2 2<>3 3<>4");
  Network network(graph, cost_by_length);
  const VertexIndex number = network.vertex_of(2);
  EXPECT_THROW(network.sync_landmark(drawn_graph("1 3 4"), 2), std::logic_error) << "its routes are still there";
  graph.remove(2);
  for (RouteId id = 1; id <= 4; ++id) network.sync_route(graph, id, cost_by_length);
  network.sync_landmark(graph, 2);
  EXPECT_EQ(broken_network(network, graph, cost_by_length), "");
  EXPECT_EQ(network.landmark_of(number), 0);
  EXPECT_EQ(network.vertex_of(2), kNoVertex);
  const LandmarkId fresh = graph.add({});
  network.sync_landmark(graph, fresh);
  EXPECT_EQ(network.vertex_of(fresh), number);
  EXPECT_EQ(network.end(), 4U);
  EXPECT_EQ(broken_network(network, graph, cost_by_length), "");
}

TEST(Network, ARouteMayGetOtherEnds) {
  LandmarkGraph graph = drawn_graph("1>2 2>3");
  Network network(graph, cost_by_length);
  Route turned = route_of(3, 1, 4.0);
  turned.id = 1;
  graph.remove_route(1);
  graph.add_route(turned);
  network.sync_route(graph, 1, cost_by_length);
  EXPECT_EQ(broken_network(network, graph, cost_by_length), "");
}

TEST(Network, RefusesACostThatNoSearchCanUseAndNamesTheRoute) {
  const LandmarkGraph graph = drawn_graph("1>2");
  for (const double bad : {-1.0, kNoRoute, std::numeric_limits<double>::quiet_NaN()}) {
    try {
      const Network network(graph, [bad](const Route&) { return bad; });
      ADD_FAILURE() << bad;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(std::string(error.what()).rfind("route 1: a cost must be finite and not negative, got ", 0), 0U);
    }
  }
}

TEST(Network, ClosedRoutesAreNotAskedForTheirCost) {
  LandmarkGraph graph = drawn_graph("1>2");
  graph.set_closed(1, true);
  EXPECT_NO_THROW(Network(graph, [](const Route&) { return -1.0; }));
}

}  // namespace
}  // namespace cairn
