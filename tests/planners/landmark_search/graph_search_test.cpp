#include "planners/landmark_search/graph_search.hpp"

#include <gtest/gtest.h>

#include "planners/landmark_search/boost_search.hpp"
#include "planners/landmark_search/hierarchy_search.hpp"
#include "tests/maps/drawn_graph.hpp"
#include "tests/maps/hierarchy/graph_laws.hpp"
#include "tests/planners/landmark_search/way_oracle.hpp"

namespace cairn {
namespace {

using test::cheapest;
using test::fault_of;
using test::GraphChanger;
using test::Question;
using test::random_question;
using test::same_cost;
using test::Variety;

constexpr ClusterSizes kSmall{4, 2, 8};
constexpr ClusterSizes kMiddle{16, 3, 40};

// What the search makes of a question is what Dijkstra makes of it.
void expect_cheapest(const Question& question, const Hierarchy& hierarchy, const LandmarkGraph& graph,
                     GraphSearch& search, const std::string& where) {
  const GraphPath path = search.find(hierarchy, query_of(question, hierarchy.network()), {});
  const double want = cheapest(graph, question);
  ASSERT_FALSE(path.stopped);
  ASSERT_TRUE(same_cost(path.cost, want)) << where << ": " << path.cost << " instead of " << want;
  ASSERT_EQ(fault_of(path, question, graph, hierarchy.network()), "") << where;
}

void expect_cheapest_on_random_graphs(GraphSearch&& search, const Variety& variety, int seeds, int questions) {
  for (int seed = 1; seed <= seeds; ++seed) {
    const LandmarkGraph graph =
        test::random_graph(static_cast<std::size_t>(3 + seed * 9), static_cast<std::uint64_t>(seed));
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    for (const ClusterSizes& sizes : {kSmall, kMiddle}) {
      const Hierarchy hierarchy(graph, {}, cost_by_length, sizes);
      for (int i = 0; i < questions; ++i)
        expect_cheapest(random_question(graph, variety, random), hierarchy, graph, search,
                        "seed " + std::to_string(seed) + ", question " + std::to_string(i));
    }
  }
}

// All that answer queries, by the same tests.
template <class Search>
class GraphSearches : public ::testing::Test {};
using AllSearches = ::testing::Types<HierarchySearch, BoostSearch>;
struct SearchNames {
  template <class Search>
  static std::string GetName(int) {
    return std::is_same_v<Search, BoostSearch> ? "Boost" : "BothEnds";
  }
};
TYPED_TEST_SUITE(GraphSearches, AllSearches, SearchNames);

TYPED_TEST(GraphSearches, FindsTheCheapestWayFromLandmarkToLandmark) {
  expect_cheapest_on_random_graphs(TypeParam(), {}, 30, 60);
}

TYPED_TEST(GraphSearches, FindsTheBestOfSeveralEndsWithTheirCosts) {
  expect_cheapest_on_random_graphs(TypeParam(), {.max_ends = 5}, 30, 30);
  expect_cheapest_on_random_graphs(TypeParam(), {.max_ends = 5, .end_costs = true}, 30, 30);
}

TYPED_TEST(GraphSearches, KeepsOffWhatIsToBeAvoided) {
  expect_cheapest_on_random_graphs(TypeParam(), {.max_avoided = 6}, 30, 60);
  expect_cheapest_on_random_graphs(TypeParam(), {.max_ends = 4, .end_costs = true, .max_avoided = 6}, 30, 60);
}

TYPED_TEST(GraphSearches, HeedsRoutesThatCostSomethingElseThisTime) {
  expect_cheapest_on_random_graphs(TypeParam(), {.max_costs = 6}, 30, 60);
  expect_cheapest_on_random_graphs(TypeParam(), {.max_costs = 60}, 30, 30);
}

TYPED_TEST(GraphSearches, HeedsAllThatAtOnce) {
  expect_cheapest_on_random_graphs(TypeParam(), {.max_ends = 4, .end_costs = true, .max_avoided = 5, .max_costs = 9},
                                   30, 60);
}

TYPED_TEST(GraphSearches, StaysExactWhileTheGraphChanges) {
  TypeParam search;
  const Variety variety{.max_ends = 3, .end_costs = true, .max_avoided = 2, .max_costs = 2};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    LandmarkGraph graph;
    GraphChanger changer(graph, seed);
    changer.grow_to(40 * seed);
    Hierarchy hierarchy(graph, {}, cost_by_length, seed % 2 == 0 ? kSmall : kMiddle);
    std::mt19937_64 random(seed);
    for (int step = 1; step <= 300; ++step) {
      hierarchy.update(graph, step % 10 == 0 ? changer.batch(12, 0.4) : changer.change(0.5));
      const std::string where = "seed " + std::to_string(seed) + ", step " + std::to_string(step);
      expect_cheapest(random_question(graph, {}, random), hierarchy, graph, search, where);
      expect_cheapest(random_question(graph, variety, random), hierarchy, graph, search, where);
    }
    const Hierarchy anew(graph, {}, cost_by_length, kSmall);
    for (int i = 0; i < 100; ++i) {
      const RouteQuery query = query_of(random_question(graph, {}, random), hierarchy.network());
      RouteQuery same = query;
      for (auto* ends : {&same.from, &same.to})
        for (SearchEnd& end : *ends) end.vertex = anew.network().vertex_of(hierarchy.network().landmark_of(end.vertex));
      EXPECT_TRUE(same_cost(search.find(hierarchy, query, {}).cost, search.find(anew, same, {}).cost));
    }
  }
}

TYPED_TEST(GraphSearches, StaysExactFromNothingToThousandsAndBack) {
  TypeParam search;
  LandmarkGraph graph;
  GraphChanger changer(graph, 77);
  Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  std::mt19937_64 random(77);
  const auto ask = [&] {
    for (int i = 0; i < 4; ++i)
      expect_cheapest(random_question(graph, {}, random), hierarchy, graph, search,
                      std::to_string(graph.landmarks().size()) + " landmarks");
  };
  while (graph.landmarks().size() < 2000) {
    hierarchy.update(graph, changer.batch(10, 0.95));
    ask();
  }
  while (graph.landmarks().size() > 8) {
    GraphChanges changes = changer.batch(2);
    for (int i = 0; i < 6; ++i) {
      changes.landmarks.push_back(changer.any_landmark());
      graph.remove(changes.landmarks.back());
    }
    hierarchy.update(graph, changes);
    ask();
  }
}

TYPED_TEST(GraphSearches, WithTheUsualSizesOfClustersToo) {
  TypeParam search;
  LandmarkGraph graph;
  GraphChanger changer(graph, 3);
  changer.grow_to(3000);
  Hierarchy hierarchy(graph);
  EXPECT_GE(hierarchy.levels(), 3);
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    if (i % 3 == 0) hierarchy.update(graph, changer.change());
    expect_cheapest(random_question(graph, {}, random), hierarchy, graph, search, std::to_string(i));
  }
}

TYPED_TEST(GraphSearches, FromALandmarkToItselfStaysThere) {
  const LandmarkGraph graph = drawn_graph("1<>2 2<>3 3<>1");
  const Hierarchy hierarchy(graph);
  const Question question{{{2, 3.0}}, {{2, 4.0}}, {2}, {}};
  const GraphPath path = TypeParam().find(hierarchy, query_of(question, hierarchy.network()), {});
  EXPECT_EQ(path.cost, 7.0);
  EXPECT_EQ(path.vertices.size(), 1U);
}

TYPED_TEST(GraphSearches, AnAvoidedEndIsAnEndAndNotPassed) {
  const LandmarkGraph graph = drawn_graph("1>2 2>3 3>4");
  const Hierarchy hierarchy(graph);
  const auto cost = [&](const Question& question) {
    return TypeParam().find(hierarchy, query_of(question, hierarchy.network()), {}).cost;
  };
  EXPECT_EQ(cost({{{1, 0.0}, {2, 50.0}}, {{4, 0.0}}, {2}, {}}), 52.0) << "from 1 one would have to pass 2";
  EXPECT_EQ(cost({{{1, 0.0}}, {{3, 50.0}, {4, 0.0}}, {3}, {}}), 52.0) << "to 4 one would have to pass 3";
  EXPECT_EQ(cost({{{1, 0.0}, {2, 9.0}}, {{1, 9.0}, {2, 0.0}}, {1, 2}, {}}), 1.0) << "from end to end";
  EXPECT_EQ(cost({{{1, 0.0}}, {{4, 0.0}}, {2}, {}}), kNoRoute);
}

TYPED_TEST(GraphSearches, WaysInAPlaceWhereNothingCostsAnythingPassNoLandmarkTwice) {
  LandmarkGraph graph = test::random_graph(120, 12);
  for (const auto& [id, route] : graph.routes()) graph.set_cost(id, id % 5 == 0 ? 1.0 : 0.0);
  TypeParam search;
  std::mt19937_64 random(12);
  const Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  for (int i = 0; i < 300; ++i)
    expect_cheapest(random_question(graph, {.max_ends = 2}, random), hierarchy, graph, search, std::to_string(i));
}

TYPED_TEST(GraphSearches, EqualQueriesGiveEqualWays) {
  const LandmarkGraph graph = test::random_graph(400, 21);
  const Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  TypeParam used;
  std::mt19937_64 random(21);
  for (int i = 0; i < 100; ++i) {
    const RouteQuery query =
        query_of(random_question(graph, {.max_ends = 3, .max_avoided = 2}, random), hierarchy.network());
    const GraphPath first = used.find(hierarchy, query, {});
    const GraphPath second = TypeParam().find(hierarchy, query, {});
    EXPECT_EQ(first.vertices, second.vertices);
    EXPECT_EQ(first.routes, second.routes);
    EXPECT_EQ(first.settled, second.settled);
  }
}

TYPED_TEST(GraphSearches, CountsWhatItSettlesByLevel) {
  const LandmarkGraph graph = test::random_graph(2000, 22);
  const Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  TypeParam search;
  std::mt19937_64 random(22);
  std::int64_t one_by_one = 0;
  std::int64_t all = 0;
  for (int i = 0; i < 50; ++i) {
    const GraphPath path =
        search.find(hierarchy, query_of(random_question(graph, {}, random), hierarchy.network()), {});
    ASSERT_EQ(path.settled_of_level.size(), static_cast<std::size_t>(hierarchy.levels()) + 1);
    std::int64_t sum = 0;
    for (const std::int64_t settled : path.settled_of_level) sum += settled;
    EXPECT_EQ(sum, path.settled);
    one_by_one += path.settled_of_level[0];
    all += path.settled;
  }
  EXPECT_LT(2 * one_by_one, all) << "most of a large graph is passed cluster by cluster";
}

TYPED_TEST(GraphSearches, StopsWhenItsBudgetIsUsedUp) {
  const LandmarkGraph graph = test::random_graph(500, 23);
  const Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  std::mt19937_64 random(23);
  TypeParam search;
  int cut = 0;
  for (int i = 0; i < 50; ++i) {
    const RouteQuery query = query_of(random_question(graph, {}, random), hierarchy.network());
    const GraphPath whole = search.find(hierarchy, query, {});
    Budget budget;
    budget.iterations = whole.settled;
    const GraphPath enough = search.find(hierarchy, query, budget);
    budget.iterations = whole.settled / 2;
    const GraphPath half = search.find(hierarchy, query, budget);
    if (whole.settled < 2) continue;
    ++cut;
    EXPECT_TRUE(half.stopped);
    EXPECT_EQ(half.cost, kNoRoute);
    EXPECT_EQ(half.settled, budget.iterations);
    EXPECT_LE(enough.settled, whole.settled);
  }
  EXPECT_GT(cut, 20);
}

}  // namespace
}  // namespace cairn
