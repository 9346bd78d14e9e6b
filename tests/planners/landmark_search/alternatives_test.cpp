#include "planners/landmark_search/alternatives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "planners/landmark_search/boost_search.hpp"
#include "planners/landmark_search/hierarchy_search.hpp"
#include "tests/maps/drawn_graph.hpp"
#include "tests/maps/hierarchy/graph_laws.hpp"
#include "tests/planners/landmark_search/way_oracle.hpp"

namespace cairn {
namespace {

using test::all_costs;
using test::Question;
using test::Variety;

constexpr ClusterSizes kSmall{2, 2, 4};

// The best path and so many after it.
template <class Search>
std::vector<GraphPath> paths(const LandmarkGraph& graph, const Question& question, int count) {
  const Hierarchy hierarchy(graph, {}, cost_by_length, kSmall);
  Search search;
  const RouteQuery query = query_of(question, hierarchy.network());
  const GraphPath best = search.find(hierarchy, query, {});
  if (!(best.cost < kNoRoute)) return {};
  std::vector<GraphPath> all = alternatives_to(best, count, hierarchy, query, search, {});
  all.insert(all.begin(), best);
  return all;
}

// A few landmarks and many routes between them, of small whole costs: there are many ties.
LandmarkGraph dense_graph(std::mt19937_64& random) {
  LandmarkGraph graph;
  const std::uint64_t landmarks = 2 + random() % 5;
  for (std::uint64_t i = 0; i < landmarks; ++i) graph.add({});
  for (std::uint64_t i = landmarks + random() % (2 * landmarks); i > 0; --i) {
    Route route;
    route.from = static_cast<LandmarkId>(1 + random() % landmarks);
    route.to = static_cast<LandmarkId>(1 + random() % landmarks);
    route.cost_m = static_cast<double>(random() % 6);
    route.closed = random() % 10 == 0;
    graph.add_route(route);
  }
  return graph;
}

template <class Search>
void expect_all_ways(const Variety& variety, std::uint64_t seeds) {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    std::mt19937_64 random(seed);
    const LandmarkGraph graph = dense_graph(random);
    const Question question = test::random_question(graph, variety, random);
    const Network network(graph, cost_by_length);
    std::vector<double> costs;
    std::set<std::pair<VertexIndex, std::vector<RouteId>>> seen;
    const int count = static_cast<int>(random() % 20);
    for (const GraphPath& path : paths<Search>(graph, question, count)) {
      ASSERT_EQ(fault_of(path, question, graph, network), "") << "seed " << seed;
      EXPECT_TRUE(seen.emplace(path.vertices.front(), path.routes).second) << "the same path twice, seed " << seed;
      costs.push_back(path.cost);
    }
    std::vector<double> want = all_costs(graph, question);
    want.resize(std::min(want.size(), static_cast<std::size_t>(count) + 1));
    ASSERT_EQ(costs, want) << "seed " << seed;
    found += costs.empty() ? 0 : costs.size() - 1;
  }
  EXPECT_GT(4 * found, seeds) << "there are alternatives in these graphs";
}

template <class Search>
class Alternatives : public ::testing::Test {};
using AllSearches = ::testing::Types<HierarchySearch, BoostSearch>;
TYPED_TEST_SUITE(Alternatives, AllSearches);

TYPED_TEST(Alternatives, AreTheNextCheapestOfAllWays) {
  expect_all_ways<TypeParam>({}, 500);
}

TYPED_TEST(Alternatives, AreTheNextCheapestFromAnyStartToAnyGoal) {
  expect_all_ways<TypeParam>({.max_ends = 3}, 500);
  expect_all_ways<TypeParam>({.max_ends = 3, .end_costs = true}, 500);
}

TYPED_TEST(Alternatives, HeedWhatTheQueryAvoidsClosesAndOpens) {
  expect_all_ways<TypeParam>({.max_ends = 2, .end_costs = true, .max_avoided = 2, .max_costs = 3}, 1000);
}

TYPED_TEST(Alternatives, TakeAnotherOfSeveralParallelRoutes) {
  LandmarkGraph graph = drawn_graph("1>2 1>2 1>2 2>3");
  graph.set_cost(2, 2.0);
  graph.set_cost(3, 5.0);
  const std::vector<GraphPath> all = paths<TypeParam>(graph, {{{1, 0.0}}, {{3, 0.0}}, {}, {}}, 5);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[1].routes, (std::vector<RouteId>{2, 4}));
  EXPECT_EQ(all[2].routes, (std::vector<RouteId>{3, 4}));
}

TYPED_TEST(Alternatives, OfAWayThatStaysWhereItIsAreNone) {
  EXPECT_EQ(paths<TypeParam>(drawn_graph("1<>2 2<>3 3<>1"), {{{1, 0.0}}, {{1, 0.0}}, {}, {}}, 5).size(), 1U);
}

TYPED_TEST(Alternatives, AreRightOnGraphsWithManyClustersToo) {
  const LandmarkGraph graph = test::random_graph(300, 5);
  const Network network(graph, cost_by_length);
  std::mt19937_64 random(5);
  for (int i = 0; i < 20; ++i) {
    const Question question = test::random_question(graph, {}, random);
    const std::vector<GraphPath> all = paths<TypeParam>(graph, question, 6);
    for (std::size_t w = 1; w < all.size(); ++w) EXPECT_GE(all[w].cost, all[w - 1].cost - 1e-9);
    for (const GraphPath& path : all) EXPECT_EQ(fault_of(path, question, graph, network), "");
  }
}

TYPED_TEST(Alternatives, EndWithTheBudget) {
  const LandmarkGraph graph = drawn_graph("1<>2 2<>3 3<>4 1<>3 2<>4 1<>4");
  const Hierarchy hierarchy(graph);
  TypeParam search;
  const RouteQuery query = query_of(Question{{{1, 0.0}}, {{4, 0.0}}, {}, {}}, hierarchy.network());
  const GraphPath best = search.find(hierarchy, query, {});
  EXPECT_EQ(alternatives_to(best, 3, hierarchy, query, search, {}).size(), 3U);
  Budget over;
  over.deadline = Budget::Clock::time_point::min();
  EXPECT_TRUE(alternatives_to(best, 3, hierarchy, query, search, over).empty());
  EXPECT_TRUE(alternatives_to(best, 0, hierarchy, query, search, {}).empty());
}

}  // namespace
}  // namespace cairn
