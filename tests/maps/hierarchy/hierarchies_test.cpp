#include "maps/hierarchy/hierarchies.hpp"

#include <gtest/gtest.h>

#include "tests/maps/hierarchy/graph_laws.hpp"

namespace cairn {
namespace {

constexpr CostKind kKinds[] = {CostKind::length, CostKind::time, CostKind::clearance};

void expect_in_line(const Hierarchies& hierarchies, const LandmarkGraph& graph, const std::string& where) {
  for (const CostKind kind : kKinds) {
    const Hierarchy& hierarchy = hierarchies.by(kind);
    const RouteCost cost = route_cost(kind, {});
    ASSERT_EQ(test::broken_network(hierarchy.network(), graph, cost), "") << name_of(kind) << ", " << where;
    ASSERT_EQ(test::broken_law(hierarchy.clustering(), hierarchy.network()), "") << name_of(kind) << ", " << where;
    ASSERT_EQ(test::broken_way(hierarchy), "") << name_of(kind) << ", " << where;
    ASSERT_EQ(test::drawn_tree(hierarchy.tree()), test::drawn_tree(hierarchies.tree()))
        << name_of(kind) << ": names mean something else, " << where;
  }
}

TEST(Hierarchies, EveryKindHasTheSameClustersAndItsOwnCosts) {
  const LandmarkGraph graph = test::random_graph(600, 1);
  const Hierarchies hierarchies(graph, {}, {});
  expect_in_line(hierarchies, graph, "as made");
  EXPECT_GE(hierarchies.by(CostKind::time).levels(), 1);
  EXPECT_EQ(&hierarchies.by(CostKind::time), &hierarchies.by(CostKind::time)) << "made once";
}

TEST(Hierarchies, AnUpdateReachesEveryKind) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    LandmarkGraph graph = test::random_graph(400, seed);
    test::GraphChanger changer(graph, seed);
    Hierarchies hierarchies(graph, {}, {});
    expect_in_line(hierarchies, graph, "as made");
    for (int step = 0; step < 20; ++step) {
      if (step % 2 == 0) {
        hierarchies.update(changer.batch(10, 0.6));
      } else {
        (void)changer.batch(10, 0.6);
        hierarchies.update();
      }
      expect_in_line(hierarchies, graph, "seed " + std::to_string(seed) + ", step " + std::to_string(step));
    }
  }
}

TEST(Hierarchies, ChangesOfCostAloneReachEveryKindAsItIs) {
  LandmarkGraph graph = test::random_graph(400, 6);
  Hierarchies hierarchies(graph, {}, {});
  const Hierarchy* const by_time = &hierarchies.by(CostKind::time);
  for (RouteId id = 1; id < 60; ++id) {
    if (id % 2 == 0)
      graph.set_cost(id, static_cast<double>(id));
    else
      graph.set_closed(id, !graph.find_route(id)->closed);
    hierarchies.update({{}, {id}});
  }
  EXPECT_EQ(&hierarchies.by(CostKind::time), by_time);
  expect_in_line(hierarchies, graph, "after changes of cost");
}

TEST(Hierarchies, AnUpdateBeforeTheFirstQuestionIsNotLost) {
  LandmarkGraph graph = test::random_graph(400, 4);
  const ClusterTree saved = Hierarchy(graph).tree();
  Hierarchies hierarchies(graph, saved, {});
  hierarchies.update(test::GraphChanger(graph, 4).batch(50));
  expect_in_line(hierarchies, graph, "made late");
}

TEST(Hierarchies, AKindThatIsMadeLateHasTheClustersOfNow) {
  LandmarkGraph graph = test::random_graph(400, 5);
  Hierarchies hierarchies(graph, {}, {});
  (void)hierarchies.by(CostKind::length);
  test::GraphChanger changer(graph, 5);
  for (int step = 0; step < 10; ++step) hierarchies.update(changer.batch(20));
  expect_in_line(hierarchies, graph, "made late");
}

TEST(Hierarchies, NameAClusterForEveryKindOfCostAndKeepIt) {
  LandmarkGraph graph;
  for (int i = 0; i < 3; ++i) graph.add({});
  const ClusterTree clusters{{{1, {1, 1, 0, 1, ""}}, {2, {2, 1, 0, 3, ""}}}, {{1, 1}, {2, 1}, {3, 2}}, 3};
  for (const bool made_before : {false, true}) {
    Hierarchies hierarchies(graph, clusters, {}, ClusterSizes{.from = 1});
    if (made_before) (void)hierarchies.by(CostKind::time);
    const ClusterTree tree = hierarchies.last_tree();
    const ClusterId last = tree.clusters.rbegin()->first;
    hierarchies.name_cluster(last, "lounge");
    EXPECT_EQ(hierarchies.last_tree().clusters.at(last).name, "lounge");
    EXPECT_EQ(hierarchies.tree(), hierarchies.by(CostKind::time).tree());
    hierarchies.name_cluster(99, "nowhere");
    EXPECT_EQ(hierarchies.last_tree(), hierarchies.tree());
  }
}

}  // namespace
}  // namespace cairn
