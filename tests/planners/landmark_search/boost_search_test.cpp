#include "planners/landmark_search/boost_search.hpp"

#include <gtest/gtest.h>

#include "planners/landmark_search/hierarchy_search.hpp"
#include "tests/maps/drawn_graph.hpp"
#include "tests/maps/hierarchy/graph_laws.hpp"
#include "tests/planners/landmark_search/way_oracle.hpp"

namespace cairn {
namespace {

// What every search must do is in graph_search_test.

using test::Question;

// A square of so many landmarks a side, a metre apart, joined both ways with their neighbours.
LandmarkGraph square_of(int side, double cost_per_m) {
  LandmarkGraph graph;
  const auto id_at = [side](int x, int y) { return static_cast<LandmarkId>(1 + x + side * y); };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      Landmark landmark;
      landmark.T_map_landmark = {static_cast<double>(x), static_cast<double>(y), 0.0};
      graph.add(landmark);
    }
  const auto join = [&](LandmarkId a, LandmarkId b) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      Route route;
      route.from = from;
      route.to = to;
      route.cost_m = cost_per_m;
      graph.add_route(route);
    }
  };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (x + 1 < side) join(id_at(x, y), id_at(x + 1, y));
      if (y + 1 < side) join(id_at(x, y), id_at(x, y + 1));
    }
  return graph;
}

std::int64_t settled(const Hierarchy& hierarchy, const Question& question) {
  return BoostSearch().find(hierarchy, query_of(question, hierarchy.network()), {}).settled;
}

const ClusterSizes kFlat = no_clusters();

TEST(BoostSearch, GoesStraightToTheGoalWhateverAMetreCosts) {
  for (const double cost_per_m : {0.2, 1.0, 7.0}) {
    const LandmarkGraph graph = square_of(15, cost_per_m);
    const Hierarchy hierarchy(graph, {}, cost_by_length, kFlat);
    EXPECT_EQ(settled(hierarchy, {{{1, 0.0}}, {{15, 0.0}}, {}, {}}), 15) << cost_per_m;
  }
}

TEST(BoostSearch, WithoutABoundItSearchesAllAround) {
  LandmarkGraph graph = square_of(15, 1.0);
  graph.set_cost(graph.routes().rbegin()->first, 0.0);
  const Hierarchy hierarchy(graph, {}, cost_by_length, kFlat);
  EXPECT_GT(settled(hierarchy, {{{1, 0.0}}, {{15, 0.0}}, {}, {}}), 80);
}

TEST(BoostSearch, ARouteThatCostsLessInTheQueryLowersTheBound) {
  const LandmarkGraph graph = square_of(6, 1.0);
  // From a landmark that is further from the goal than the start.
  LandmarkGraph with_shortcut = graph;
  Route shortcut;
  shortcut.from = 7;
  shortcut.to = 6;
  shortcut.cost_m = 50.0;
  const RouteId id = with_shortcut.add_route(shortcut);
  const Hierarchy of_both(with_shortcut, {}, cost_by_length, kFlat);
  const Question question{{{1, 0.0}}, {{6, 0.0}}, {}, {{id, 0.25}}};
  EXPECT_EQ(BoostSearch().find(of_both, query_of(question, of_both.network()), {}).cost, 1.25);
}

TEST(BoostSearch, StaysExactWhenLandmarksMoveWithoutAReport) {
  LandmarkGraph graph = test::random_graph(120, 8);
  Hierarchy hierarchy(graph, {}, cost_by_length, ClusterSizes{4, 2, 8});
  std::mt19937_64 random(8);
  BoostSearch search;
  for (int i = 0; i < 200; ++i) {
    Landmark& moved = *graph.find(test::random_question(graph, {}, random).from.begin()->first);
    moved.T_map_landmark.x_m += static_cast<double>(random() % 100) - 50.0;
    if (i % 3 == 0) hierarchy.update(graph, {{moved.id}, {}});
    if (i % 5 == 0) hierarchy.update(graph, {{}, {graph.routes().begin()->first}});
    const Question question = test::random_question(graph, {.max_ends = 2}, random);
    const GraphPath path = search.find(hierarchy, query_of(question, hierarchy.network()), {});
    ASSERT_TRUE(test::same_cost(path.cost, test::cheapest(graph, question))) << i;
  }
}

TEST(BoostSearch, PassesMostOfALargeGraphOnHighLevels) {
  const LandmarkGraph graph = square_of(60, 1.0);
  const Hierarchy hierarchy(graph);
  ASSERT_GE(hierarchy.levels(), 3);
  const RouteQuery query = query_of(Question{{{1, 0.0}}, {{3600, 0.0}}, {}, {}}, hierarchy.network());
  const GraphPath path = BoostSearch().find(hierarchy, query, {});
  EXPECT_EQ(path.cost, 118.0);
  EXPECT_GT(path.settled_of_level.back(), 0);
  EXPECT_LT(path.settled, 1000);
}

TEST(BoostSearch, AnswersAsTheSearchFromBothEndsOnALargerGraph) {
  const LandmarkGraph graph = test::random_graph(3000, 15);
  const Hierarchy hierarchy(graph);
  BoostSearch boost;
  HierarchySearch bidirectional;
  std::mt19937_64 random(15);
  for (int i = 0; i < 300; ++i) {
    const RouteQuery query = query_of(
        test::random_question(graph, {.max_ends = 3, .max_avoided = 2, .max_costs = 2}, random), hierarchy.network());
    ASSERT_TRUE(test::same_cost(boost.find(hierarchy, query, {}).cost, bidirectional.find(hierarchy, query, {}).cost));
  }
}

}  // namespace
}  // namespace cairn
