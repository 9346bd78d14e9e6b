#include "plugins/behaviours/errands/visiting_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace cairn::behaviours {
namespace {

using Costs = std::vector<std::vector<double>>;

// Distances between random points, with or without a detour for each pair: not always as on a plane.
Costs random_costs(std::size_t places, std::uint64_t seed, double detours) {
  std::mt19937_64 random(seed);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i <= places; ++i) {
    const double x = 10.0 * number();
    points.emplace_back(x, 10.0 * number());
  }
  Costs cost(places + 1, std::vector<double>(places + 1, 0.0));
  for (std::size_t i = 0; i <= places; ++i)
    for (std::size_t j = i + 1; j <= places; ++j)
      cost[i][j] = cost[j][i] = std::hypot(points[i].first - points[j].first, points[i].second - points[j].second) *
                                (1.0 + detours * number());
  return cost;
}

double min_of_all_permutations(const Costs& cost) {
  std::vector<std::size_t> order(cost.size() - 1);
  std::iota(order.begin(), order.end(), 1);
  double least = cost_of(order, cost);
  while (std::ranges::next_permutation(order).found) least = std::min(least, cost_of(order, cost));
  return least;
}

void expect_each_once(std::vector<std::size_t> order, std::size_t places) {
  std::ranges::sort(order);
  std::vector<std::size_t> all(places);
  std::iota(all.begin(), all.end(), 1);
  EXPECT_EQ(order, all);
}

TEST(VisitingOrder, IsTheBestOfAllPermutations) {
  for (std::size_t places = 1; places <= 7; ++places)
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const Costs cost = random_costs(places, seed, 2.0);
      const std::vector<std::size_t> order = shortest_order(cost);
      expect_each_once(order, places);
      EXPECT_NEAR(cost_of(order, cost), min_of_all_permutations(cost), 1e-9) << places << " places, seed " << seed;
    }
}

TEST(VisitingOrder, OfManyPlacesIsNearTheBest) {
  // Eleven are solved exactly; the same with one more on top of the last one must not cost much more.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Costs eleven = random_costs(kMaxExactPlaces, seed, 0.0);
    Costs twelve = eleven;
    for (std::vector<double>& row : twelve) row.push_back(row.back());
    twelve.push_back(twelve.back());
    twelve.back().back() = 0.0;
    const std::vector<std::size_t> order = shortest_order(twelve);
    expect_each_once(order, kMaxExactPlaces + 1);
    EXPECT_LE(cost_of(order, twelve), 1.25 * cost_of(shortest_order(eleven), eleven)) << seed;
  }
}

TEST(VisitingOrder, OfNothingIsNothingAndEqualCostsKeepTheOrder) {
  EXPECT_TRUE(shortest_order({}).empty());
  EXPECT_TRUE(shortest_order({{0.0}}).empty());
  const Costs equal{{0, 1, 1, 1}, {1, 0, 1, 1}, {1, 1, 0, 1}, {1, 1, 1, 0}};
  EXPECT_EQ(cost_of(shortest_order(equal), equal), 3.0);
  expect_each_once(shortest_order(random_costs(50, 3, 1.0)), 50);
}

}  // namespace
}  // namespace cairn::behaviours
