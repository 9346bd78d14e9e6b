#include "maps/hierarchy/hierarchy.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/maps/hierarchy/graph_laws.hpp"

namespace cairn {
namespace {

using test::broken_law;
using test::broken_network;
using test::broken_way;
using test::GraphChanger;

constexpr ClusterSizes kSmall{4, 2, 8};
constexpr ClusterSizes kMiddle{16, 3, 40};

// Nothing when all laws hold.
std::string broken(const Hierarchy& hierarchy, const LandmarkGraph& graph) {
  if (std::string law = broken_network(hierarchy.network(), graph, cost_by_length); !law.empty()) return law;
  if (std::string law = broken_law(hierarchy.clustering(), hierarchy.network()); !law.empty()) return law;
  return broken_way(hierarchy);
}

// Whether a cluster has got an id that was given before.
class IdsSeen {
 public:
  bool is_given_twice(const ClusterTree& tree) {
    bool twice = false;
    for (const auto& [id, cluster] : tree.clusters) {
      twice = twice || (!present_.contains(id) && id < next_id_);
      present_.insert(id);
    }
    std::erase_if(present_, [&](ClusterId id) { return !tree.clusters.contains(id); });
    next_id_ = tree.next_id;
    return twice;
  }

 private:
  std::set<ClusterId> present_;
  ClusterId next_id_ = 1;
};

struct Run {
  ClusterSizes sizes;
  std::size_t begin = 0;  // landmarks
  int steps = 0;
  int max_changes = 1;  // of one step
  double growth = 0.5;
  int check_every = 1;
};

void expect_laws_hold(const Run& run, std::uint64_t seed) {
  LandmarkGraph graph;
  GraphChanger changer(graph, seed);
  changer.grow_to(run.begin);
  Hierarchy hierarchy(graph, {}, cost_by_length, run.sizes);
  ASSERT_EQ(broken(hierarchy, graph), "") << "seed " << seed << ", as made";
  IdsSeen ids;
  ASSERT_FALSE(ids.is_given_twice(hierarchy.tree()));
  for (int step = 1; step <= run.steps; ++step) {
    const int changes = 1 + static_cast<int>(changer.number_below(static_cast<std::size_t>(run.max_changes)));
    hierarchy.update(graph, changer.batch(changes, run.growth));
    ASSERT_FALSE(ids.is_given_twice(hierarchy.tree())) << "seed " << seed << ", step " << step;
    if (step % run.check_every == 0) {
      ASSERT_EQ(broken(hierarchy, graph), "")
          << "seed " << seed << ", step " << step << ", " << graph.landmarks().size() << " landmarks";
    }
  }
}

TEST(Hierarchy, KeepsItsLawsThroughThousandsOfSingleChanges) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const std::size_t begin = 10 * seed;
    expect_laws_hold({.sizes = kSmall, .begin = begin, .steps = 200, .growth = 0.45, .check_every = 2}, seed);
    expect_laws_hold({.sizes = kMiddle, .begin = begin, .steps = 200, .growth = 0.45, .check_every = 2}, seed);
  }
}

TEST(Hierarchy, KeepsItsLawsThroughBatchesOfChanges) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    expect_laws_hold({.sizes = kSmall, .begin = 150, .steps = 40, .max_changes = 40}, seed);
    expect_laws_hold({.sizes = kMiddle, .begin = 300, .steps = 40, .max_changes = 80, .growth = 0.3}, seed);
  }
}

TEST(Hierarchy, KeepsItsLawsWithTheUsualSizesOfClusters) {
  expect_laws_hold({.sizes = {}, .begin = 1500, .steps = 300, .check_every = 30}, 1);
}

TEST(Hierarchy, GrowsFromNothingAndShrinksBackToNothing) {
  LandmarkGraph graph;
  GraphChanger changer(graph, 5);
  Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  int max_levels = 0;
  while (graph.landmarks().size() < 2000) {
    hierarchy.update(graph, changer.batch(20, 0.95));
    max_levels = std::max(max_levels, hierarchy.levels());
    if (changer.number_below(15) == 0) {
      ASSERT_EQ(broken(hierarchy, graph), "") << graph.landmarks().size();
    }
  }
  EXPECT_GE(max_levels, 7);
  while (!graph.landmarks().empty()) {
    GraphChanges changes;
    for (int i = 0; i < 20 && !graph.landmarks().empty(); ++i) {
      changes.landmarks.push_back(changer.any_landmark());
      graph.remove(changes.landmarks.back());
    }
    hierarchy.update(graph, changes);
    if (changer.number_below(10) == 0) {
      ASSERT_EQ(broken(hierarchy, graph), "") << graph.landmarks().size();
    }
  }
  EXPECT_EQ(hierarchy.levels(), 0);
  EXPECT_EQ(broken(hierarchy, graph), "");
}

TEST(Hierarchy, FindsOutByItselfWhatHasChanged) {
  LandmarkGraph graph;
  GraphChanger changer(graph, 9);
  changer.grow_to(200);
  Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  for (int step = 0; step < 60; ++step) {
    (void)changer.batch(1 + step % 12);
    hierarchy.update(graph);
    ASSERT_EQ(broken(hierarchy, graph), "") << "step " << step;
  }
}

TEST(Hierarchy, NamingMoreThanHasChangedDoesNoHarm) {
  LandmarkGraph graph = test::random_graph(200, 4);
  Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  const ClusterTree before = hierarchy.tree();
  GraphChanges all{{0, -7, 100'000}, {0, -7, 100'000}};
  for (const auto& [id, landmark] : graph.landmarks()) all.landmarks.push_back(id);
  for (const auto& [id, route] : graph.routes()) all.routes.push_back(id);
  hierarchy.update(graph, all);
  EXPECT_EQ(broken(hierarchy, graph), "");
  EXPECT_EQ(hierarchy.tree(), before);
}

TEST(Hierarchy, ChangesOfCostLeaveTheClustersAsTheyAre) {
  LandmarkGraph graph = test::random_graph(300, 6);
  Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  const ClusterTree before = hierarchy.tree();
  std::mt19937_64 random(6);
  for (int step = 0; step < 300; ++step) {
    GraphChanges changes;
    for (std::size_t i = 0; i <= random() % 3; ++i) {
      const RouteId id = static_cast<RouteId>(1 + random() % graph.routes().size());
      changes.routes.push_back(id);
      if (random() % 3 == 0)
        graph.set_closed(id, !graph.find_route(id)->closed);
      else
        graph.set_cost(id, static_cast<double>(random() % 50));
    }
    hierarchy.update(graph, changes);
    ASSERT_EQ(broken(hierarchy, graph), "") << "step " << step;
  }
  EXPECT_EQ(hierarchy.tree(), before);
}

TEST(Hierarchy, ALandmarkThatComesBackUnderItsOldIdIsAsGoodAsNew) {
  LandmarkGraph graph = test::random_graph(100, 3);
  Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  Landmark back = *graph.find(50);
  GraphChanges changes{{50}, graph.routes_from(50)};
  changes.routes.insert(changes.routes.end(), graph.routes_to(50).begin(), graph.routes_to(50).end());
  graph.remove(50);
  graph.add(back);
  Route route;
  route.id = changes.routes.front();
  route.from = 50;
  route.to = 7;
  route.cost_m = 1.5;
  graph.add_route(route);
  hierarchy.update(graph, changes);
  EXPECT_EQ(broken(hierarchy, graph), "");
}

TEST(Hierarchy, RefusesACostThatNoSearchCanUse) {
  const LandmarkGraph graph = test::random_graph(10, 1);
  EXPECT_THROW(Hierarchy(graph, {}, [](const Route&) { return -1.0; }), std::invalid_argument);
  EXPECT_THROW(Hierarchy(graph, {}, [](const Route&) { return kNoRoute; }), std::invalid_argument);
  EXPECT_THROW(Hierarchy(graph, {}, cost_by_length, ClusterSizes{1, 2, 8}), std::invalid_argument);
}

}  // namespace
}  // namespace cairn
