#include "planners/landmark_search/landmark_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "maps/hierarchy/hierarchies.hpp"
#include "planners/landmark_search/flat_search.hpp"
#include "tests/maps/hierarchy/graph_laws.hpp"
#include "tests/planners/landmark_search/graph_world.hpp"

namespace cairn {
namespace {

using ::testing::ElementsAre;

using test::GraphWorld;
using test::line_of;
using test::request;

constexpr LandmarkSearchConfig kBoost{.bidirectional_from = 1'000'000'000};
constexpr LandmarkSearchConfig kBothEnds{.bidirectional_from = 0};

// The searches over the landmark graph, which must agree.
class GraphPlanner : public ::testing::TestWithParam<const char*> {
 protected:
  static RouteResult plan(const GraphWorld& world, const RouteRequest& asked, const Budget& budget = {}) {
    const std::string kind = GetParam();
    if (kind == "Flat") return world.plan(FlatSearch(), asked, budget);
    const Hierarchies hierarchies = world.hierarchies();
    const LandmarkSearch search(kind.starts_with("Boost") ? kBoost : kBothEnds);
    return world.plan(search, asked, budget, kind.ends_with("OnHierarchies") ? &hierarchies : nullptr);
  }
  static RouteResult plan(const GraphWorld& world, std::vector<LandmarkId> from, std::vector<LandmarkId> to,
                          const Budget& budget = {}) {
    return plan(world, request(std::move(from), std::move(to)), budget);
  }
};

INSTANTIATE_TEST_SUITE_P(, GraphPlanner,
                         ::testing::Values("Flat", "BoostAlone", "BoostOnHierarchies", "BothEndsAlone",
                                           "BothEndsOnHierarchies"),
                         [](const auto& one) { return std::string(one.param); });

TEST_P(GraphPlanner, TakesTheCheaperOfTwoWaysAndNotTheShorterList) {
  GraphWorld world = line_of(3);
  world.route(1, 3, 5.0);
  const RouteResult result = plan(world, {1}, {3});
  EXPECT_EQ(result.outcome, PlanOutcome::solved);
  EXPECT_DOUBLE_EQ(result.cost_m, 2.0);
  EXPECT_THAT(result.landmarks, ElementsAre(1, 2, 3));
  EXPECT_THAT(result.routes, ElementsAre(1, 2));
}

TEST_P(GraphPlanner, OfParallelRoutesTakesTheCheapestThatIsOpen) {
  GraphWorld world = line_of(2);
  const RouteId cheap = world.route(1, 2, 0.5);
  const RouteId middle = world.route(1, 2, 0.7);
  EXPECT_THAT(plan(world, {1}, {2}).routes, ElementsAre(cheap));
  world.graph.set_closed(cheap, true);
  EXPECT_THAT(plan(world, {1}, {2}).routes, ElementsAre(middle));
}

TEST_P(GraphPlanner, RoutesAreDirected) {
  const RouteResult result = plan(line_of(2), {2}, {1});
  EXPECT_EQ(result.outcome, PlanOutcome::no_route);
  EXPECT_EQ(result.reason, "no open route leads from L2 to L1");
}

TEST_P(GraphPlanner, WithSeveralGoalsTakesTheCheapest) {
  GraphWorld world = line_of(5);
  EXPECT_THAT(plan(world, {2}, {5, 4, 1}).landmarks, ElementsAre(2, 3, 4));
  EXPECT_THAT(plan(world, {1, 3}, {5}).landmarks, ElementsAre(3, 4, 5)) << "and of several starts";
}

TEST(LandmarkSearch, SettlesLittleMoreThanLiesBetween) {
  const GraphWorld world = line_of(1000);
  const Hierarchies hierarchies = world.hierarchies();
  for (const LandmarkSearchConfig& config : {kBoost, kBothEnds}) {
    EXPECT_LE(world.plan(LandmarkSearch(config), request({1}, {10})).settled, 10);
    EXPECT_LE(world.plan(LandmarkSearch(config), request({1}, {1000}), {}, &hierarchies).settled, 200)
        << "most clusters are passed as a whole";
  }
}

TEST_P(GraphPlanner, FromALandmarkToItselfCostsNothing) {
  const RouteResult result = plan(line_of(2), {2}, {2});
  EXPECT_EQ(result.outcome, PlanOutcome::solved);
  EXPECT_EQ(result.cost_m, 0.0);
  EXPECT_THAT(result.landmarks, ElementsAre(2));
}

TEST_P(GraphPlanner, APlaceItCannotUseIsAnOutcomeWithASentence) {
  const GraphWorld world = line_of(2);
  EXPECT_EQ(plan(world, {1}, {9}).outcome, PlanOutcome::unknown_place);
  EXPECT_EQ(plan(world, {1}, {9}).reason, "the map has no landmark L9 (goal)");
  EXPECT_EQ(plan(world, {}, {1}).reason, "the request names no start");
  EXPECT_EQ(plan(world, {1}, {}).reason, "the request names no goal");
}

TEST_P(GraphPlanner, KeepsToItsBudget) {
  const GraphWorld world = line_of(2000);
  const std::atomic<bool> cancel{true};
  Budget cancelled;
  cancelled.cancel = &cancel;
  EXPECT_EQ(plan(world, {1}, {2000}, cancelled).outcome, PlanOutcome::cancelled);
  Budget late;
  late.deadline = Budget::Clock::time_point::min();
  EXPECT_EQ(plan(world, {1}, {2000}, late).outcome, PlanOutcome::out_of_budget);
  Budget few;
  few.iterations = 10;  // few even for who passes clusters as a whole
  EXPECT_EQ(plan(world, {1}, {2000}, few).outcome, PlanOutcome::out_of_budget);
  few.iterations = 100;
  EXPECT_EQ(plan(world, {1}, {50}, few).outcome, PlanOutcome::solved);
  few.iterations = 0;
  EXPECT_EQ(plan(world, {1}, {1}, few).outcome, PlanOutcome::out_of_budget);
}

TEST_P(GraphPlanner, CostsAreThoseOfFloydWarshallOnRandomGraphs) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    std::mt19937_64 random(seed);
    const int n = 2 + static_cast<int>(random() % 14);
    GraphWorld world;
    for (int i = 0; i < n; ++i) world.landmark(i, i % 3);
    std::vector<std::vector<double>> best(n, std::vector<double>(n, kInfinity));
    for (int i = 0; i < n; ++i) best[i][i] = 0.0;
    const int routes = static_cast<int>(random() % (3 * n));
    for (int k = 0; k < routes; ++k) {
      const int a = static_cast<int>(random() % n);
      const int b = static_cast<int>(random() % n);
      const double cost_m = random() % 5 == 0 ? 0.0 : static_cast<double>(random() % 1000) / 100.0;
      const RouteId id = world.route(a + 1, b + 1, cost_m);
      const bool closed = random() % 6 == 0;
      world.graph.set_closed(id, closed);
      if (!closed) best[a][b] = std::min(best[a][b], cost_m);
    }
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) best[i][j] = std::min(best[i][j], best[i][k] + best[k][j]);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const RouteResult result = plan(world, {i + 1}, {j + 1});
        ASSERT_EQ(result.outcome == PlanOutcome::solved, best[i][j] < kInfinity) << "seed " << seed;
        if (result.outcome != PlanOutcome::solved) continue;
        EXPECT_NEAR(result.cost_m, best[i][j], 1e-9) << "seed " << seed << ", L" << i + 1 << " to L" << j + 1;
        double sum_m = 0.0;
        LandmarkId at = i + 1;
        for (const RouteId id : result.routes) {
          const Route& route = *world.graph.find_route(id);
          EXPECT_EQ(route.from, at);
          EXPECT_FALSE(route.closed);
          sum_m += route.cost_m;
          at = route.to;
        }
        EXPECT_EQ(at, j + 1);
        EXPECT_NEAR(sum_m, result.cost_m, 1e-9);
      }
    }
  }
}

TEST_P(GraphPlanner, AvoidedLandmarksAndClosedRoutesAreNotUsed) {
  GraphWorld world = line_of(3);
  const RouteId bridge = world.route(1, 3, 5.0);
  RouteRequest asked = request({1}, {3});
  asked.avoid = {2, 99};
  EXPECT_THAT(plan(world, asked).routes, ElementsAre(bridge));
  asked.closed = {bridge, 99};
  EXPECT_EQ(plan(world, asked).outcome, PlanOutcome::no_route);
  EXPECT_EQ(plan(world, asked).reason, "no open route leads from L1 to L3 past what is to be avoided");
  asked.avoid = {1, 3};
  EXPECT_THAT(plan(world, asked).landmarks, ElementsAre(1, 2, 3)) << "ends may be among those to be avoided";
}

TEST_P(GraphPlanner, EndsHaveTheirCosts) {
  const GraphWorld world = line_of(5);
  RouteRequest asked;
  asked.from = {{1, 0.5}, {2, 4.0}};
  asked.to = {{4, 3.0}, {5, 0.25}};
  const RouteResult result = plan(world, asked);
  EXPECT_THAT(result.landmarks, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_DOUBLE_EQ(result.cost_m, 4.75);
}

TEST(LandmarkSearch, CostsTheSameWithHierarchiesAndWithoutAndAsTheFlatSearch) {
  GraphWorld world;
  world.graph = test::random_graph(900, 31);
  const Hierarchies hierarchies = world.hierarchies();
  ASSERT_GE(hierarchies.by(CostKind::length).levels(), 2);
  const LandmarkSearch boost(kBoost);
  const LandmarkSearch both_ends(kBothEnds);
  std::mt19937_64 random(31);
  const auto any = [&] { return static_cast<LandmarkId>(1 + random() % 900); };
  for (int i = 0; i < 60; ++i) {
    RouteRequest asked = request({any(), any()}, {any(), any()});
    if (asked.from[0].landmark == asked.from[1].landmark) asked.from.pop_back();
    asked.avoid = {any(), any(), any()};
    asked.closed = {any(), any()};
    const RouteResult flat = world.plan(FlatSearch(), asked);
    for (const LandmarkSearch* const search : {&boost, &both_ends})
      for (const Hierarchies* const given : {&hierarchies, static_cast<const Hierarchies*>(nullptr)}) {
        const RouteResult result = world.plan(*search, asked, {}, given);
        ASSERT_EQ(result.outcome, flat.outcome) << i;
        EXPECT_EQ(result.reason, result.outcome == PlanOutcome::solved ? result.reason : flat.reason) << i;
        EXPECT_NEAR(result.cost_m, flat.cost_m, 1e-9) << i;
      }
  }
}

TEST(LandmarkSearch, ComparesByTheKindOfCostThatIsAskedFor) {
  GraphWorld world = line_of(2);
  const RouteId fast = world.route(1, 2, 1.5);
  world.graph.remove_route(1);
  Route slow;
  slow.from = 1;
  slow.to = 2;
  slow.cost_m = 1.0;
  slow.speed_limit_mps = 0.01;
  const RouteId slow_id = world.graph.add_route(slow);
  const Hierarchies hierarchies = world.hierarchies();
  RouteRequest asked = request({1}, {2});
  asked.explain = true;
  for (const Hierarchies* const given : {&hierarchies, static_cast<const Hierarchies*>(nullptr)}) {
    asked.cost = CostKind::length;
    EXPECT_THAT(world.plan(LandmarkSearch(), asked, {}, given).routes, ElementsAre(slow_id));
    asked.cost = CostKind::time;
    const RouteResult by_time = world.plan(LandmarkSearch(), asked, {}, given);
    EXPECT_THAT(by_time.routes, ElementsAre(fast));
    EXPECT_DOUBLE_EQ(by_time.cost_m, 1.5) << "in metres all the same";
    EXPECT_DOUBLE_EQ(by_time.explanation->cost.value(), 1.5 / world.robot.max_v_mps);
  }
}

TEST(LandmarkSearch, HierarchiesThatWereNotUpdatedAreABugItNames) {
  GraphWorld world = line_of(2);
  const Hierarchies hierarchies = world.hierarchies();
  (void)hierarchies.by(CostKind::length);
  world.landmark(9.0, 9.0);
  EXPECT_THROW((void)world.plan(LandmarkSearch(), request({1}, {3}), {}, &hierarchies), std::logic_error);
}

TEST(LandmarkSearch, GivesAlternativesByRisingCost) {
  GraphWorld world = line_of(3);
  const RouteId bridge = world.route(1, 3, 5.0);
  const RouteId second = world.route(2, 3, 1.5);
  RouteRequest asked = request({1}, {3});
  asked.alternatives = 9;
  asked.to.front().cost = 10.0;
  const RouteResult result = world.plan(LandmarkSearch(), asked);
  EXPECT_DOUBLE_EQ(result.cost_m, 12.0);
  ASSERT_EQ(result.alternatives.size(), 2U);
  EXPECT_THAT(result.alternatives[0].routes, ElementsAre(1, second));
  EXPECT_THAT(result.alternatives[0].landmarks, ElementsAre(1, 2, 3));
  EXPECT_DOUBLE_EQ(result.alternatives[0].cost_m, 12.5);
  EXPECT_THAT(result.alternatives[1].routes, ElementsAre(bridge));
  EXPECT_DOUBLE_EQ(result.alternatives[1].cost_m, 15.0);
}

}  // namespace
}  // namespace cairn
