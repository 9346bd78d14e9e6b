#include "planners/landmark_search/landmark_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/planners/drawn_world.hpp"

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A world without a grid.
struct GraphWorld {
  OccupancyGrid grid{0.1};
  LandmarkGraph graph;
  RobotModel robot;

  LandmarkId landmark(double x_m, double y_m) {
    Landmark landmark;
    landmark.T_map_landmark = {x_m, y_m, 0.0};
    return graph.add(landmark);
  }
  RouteId route(LandmarkId from, LandmarkId to, double cost_m, std::vector<Pose2> trajectory = {}) {
    Route route;
    route.from = from;
    route.to = to;
    route.cost_m = cost_m;
    route.trajectory = std::move(trajectory);
    return graph.add_route(route);
  }
  PlanResult plan(std::vector<LandmarkId> from, std::vector<LandmarkId> to, const Budget& budget = {}) const {
    PlanRequest request;
    request.from.landmarks = std::move(from);
    request.to.landmarks = std::move(to);
    return LandmarkSearch().plan(request, {grid, graph, robot, {}, 0.0, nullptr, 0.0}, budget);
  }
};

// A line of n landmarks a metre apart, joined in rising order.
GraphWorld line_of(int n) {
  GraphWorld world;
  for (int i = 0; i < n; ++i) world.landmark(i, 0.0);
  for (int i = 1; i < n; ++i) world.route(i, i + 1, 1.0);
  return world;
}

TEST(LandmarkSearch, TakesTheCheaperOfTwoWaysAndNotTheShorterList) {
  GraphWorld world = line_of(3);
  world.route(1, 3, 5.0);
  const PlanResult result = world.plan({1}, {3});
  EXPECT_EQ(result.outcome, PlanOutcome::solved);
  EXPECT_DOUBLE_EQ(result.cost_m, 2.0);
  EXPECT_THAT(result.landmarks, ElementsAre(1, 2, 3));
  EXPECT_THAT(result.routes, ElementsAre(1, 2));
  EXPECT_EQ(result.settled, 2);
  EXPECT_EQ(result.path.size(), 3U);
  EXPECT_DOUBLE_EQ(result.length_m, 2.0);
}

TEST(LandmarkSearch, OfParallelRoutesTakesTheCheapestThatIsOpen) {
  GraphWorld world = line_of(2);
  const RouteId cheap = world.route(1, 2, 0.5);
  const RouteId middle = world.route(1, 2, 0.7);
  EXPECT_THAT(world.plan({1}, {2}).routes, ElementsAre(cheap));
  world.graph.set_closed(cheap, true);
  EXPECT_THAT(world.plan({1}, {2}).routes, ElementsAre(middle));
}

TEST(LandmarkSearch, RoutesAreDirected) {
  const PlanResult result = line_of(2).plan({2}, {1});
  EXPECT_EQ(result.outcome, PlanOutcome::no_route);
  EXPECT_EQ(result.reason, "no open route leads from L2 to L1");
}

TEST(LandmarkSearch, WithSeveralGoalsTakesTheCheapest) {
  GraphWorld world = line_of(5);
  EXPECT_THAT(world.plan({2}, {5, 4, 1}).landmarks, ElementsAre(2, 3, 4));
  EXPECT_THAT(world.plan({1, 3}, {5}).landmarks, ElementsAre(3, 4, 5)) << "and of several starts";
}

TEST(LandmarkSearch, StopsAsSoonAsTheGoalIsSettled) {
  EXPECT_EQ(line_of(1000).plan({1}, {10}).settled, 9);
}

TEST(LandmarkSearch, FromALandmarkToItselfCostsNothing) {
  const PlanResult result = line_of(2).plan({2}, {2});
  EXPECT_EQ(result.outcome, PlanOutcome::solved);
  EXPECT_EQ(result.cost_m, 0.0);
  EXPECT_THAT(result.landmarks, ElementsAre(2));
  EXPECT_EQ(result.path.size(), 1U);
}

TEST(LandmarkSearch, JoinsStoredTrajectoriesAndFillsGapsWithStandingPlaces) {
  GraphWorld world;
  world.landmark(0.0, 0.0);
  world.landmark(2.0, 0.0);
  world.landmark(4.0, 0.0);
  world.graph.find(3)->access = Pose2{3.5, 0.0, 0.0};
  world.route(1, 2, 2.0, {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}});
  world.route(2, 3, 2.0);
  EXPECT_THAT(world.plan({1}, {3}).path, ElementsAre(Pose2{0, 0, 0}, Pose2{1, 1, 0}, Pose2{2, 0, 0}, Pose2{3.5, 0, 0}));
}

TEST(LandmarkSearch, APlaceItCannotUseIsAnOutcomeWithASentence) {
  const GraphWorld world = line_of(2);
  EXPECT_EQ(world.plan({1}, {9}).outcome, PlanOutcome::unknown_place);
  EXPECT_EQ(world.plan({1}, {9}).reason, "the map has no landmark L9 (goal)");
  EXPECT_EQ(world.plan({}, {1}).reason, "the request names no start");
  PlanRequest request;
  request.from.pose = Pose2{};
  request.to.landmarks = {1};
  const PlanResult result =
      LandmarkSearch().plan(request, {world.grid, world.graph, world.robot, {}, 0.0, nullptr, 0.0}, {});
  EXPECT_EQ(result.outcome, PlanOutcome::unknown_place);
  EXPECT_THAT(result.reason, HasSubstr("needs landmarks"));
}

TEST(LandmarkSearch, KeepsToItsBudget) {
  const GraphWorld world = line_of(2000);
  const std::atomic<bool> cancel{true};
  Budget cancelled;
  cancelled.cancel = &cancel;
  EXPECT_EQ(world.plan({1}, {2000}, cancelled).outcome, PlanOutcome::cancelled);
  Budget late;
  late.deadline = Budget::Clock::time_point::min();
  EXPECT_EQ(world.plan({1}, {2000}, late).outcome, PlanOutcome::out_of_budget);
  Budget few;
  few.iterations = 100;
  EXPECT_EQ(world.plan({1}, {2000}, few).outcome, PlanOutcome::out_of_budget);
  EXPECT_EQ(world.plan({1}, {50}, few).outcome, PlanOutcome::solved);
  few.iterations = 0;
  EXPECT_EQ(world.plan({1}, {1}, few).outcome, PlanOutcome::out_of_budget);
}

TEST(LandmarkSearch, CostsAreThoseOfFloydWarshallOnRandomGraphs) {
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
        const PlanResult result = world.plan({i + 1}, {j + 1});
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

}  // namespace
}  // namespace cairn
