#include "maps/grid/travel_regions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/maps/drawn_grid.hpp"

namespace cairn {
namespace {

// Travel between all pairs of cells that a disc steps through, by relaxing steps until nothing changes.
double travel_m(const DiscLattice& lattice, Cell from, Cell to) {
  std::map<Cell, double> cost{{from, 0.0}};
  for (bool changed = lattice.fits(from); changed;) {
    changed = false;
    for (const auto& [cell, here_m] : std::map(cost))
      for (int step = 0; step < 8; ++step) {
        if (!lattice.may_step(cell, step)) continue;
        const Cell by = DiscLattice::kSteps[step];
        const double there_m = here_m + lattice.cell_m() * std::hypot(by.x, by.y);
        const auto [known, is_new] = cost.emplace(cell + by, there_m);
        if (!is_new && known->second <= there_m + 1e-9) continue;
        known->second = there_m;
        changed = true;
      }
  }
  return cost.contains(to) ? cost.at(to) : std::numeric_limits<double>::infinity();
}

struct Edge {
  double length_m;
  std::size_t a, b;
};

// The total length of a minimum spanning forest, and its number of edges.
std::pair<double, int> spanning_forest(std::vector<Edge> edges, std::size_t places) {
  std::vector<std::size_t> set(places);
  std::iota(set.begin(), set.end(), std::size_t{0});
  std::ranges::sort(edges, {}, &Edge::length_m);
  std::pair<double, int> forest{0.0, 0};
  for (const Edge& edge : edges) {
    if (set[edge.a] == set[edge.b] || !std::isfinite(edge.length_m)) continue;
    std::ranges::replace(set, std::size_t{set[edge.a]}, std::size_t{set[edge.b]});
    forest.first += edge.length_m;
    ++forest.second;
  }
  return forest;
}

TEST(TravelRegions, TheBordersHoldAMinimumSpanningForestOfAllTravel) {
  std::mt19937_64 random(5);
  int apart = 0;
  for (int trial = 0; trial < 20; ++trial) {
    OccupancyGrid grid(0.1);
    for (int i = 0; i < 100; ++i) grid.set_log_odds({i % 10, i / 10}, random() % 3 == 0 ? LogOdds{900} : LogOdds{-900});
    const DiscLattice lattice(DistanceField(grid, UnknownPolicy::avoid), 0.02);
    std::vector<Cell> places;
    for (int i = 0; i < 5; ++i) places.push_back({static_cast<int>(random() % 10), static_cast<int>(random() % 10)});
    std::vector<Edge> all;
    for (std::size_t a = 0; a < places.size(); ++a)
      for (std::size_t b = a + 1; b < places.size(); ++b)
        if (lattice.fits(places[a])) all.push_back({travel_m(lattice, places[a], places[b]), a, b});
    std::vector<Edge> borders;
    const TravelRegions regions(lattice, places);
    for (const TravelRegions::Border& border : regions.borders())
      borders.push_back({border.length_m, border.first, border.second});
    const auto expected = spanning_forest(all, places.size());
    const auto found = spanning_forest(borders, places.size());
    EXPECT_EQ(found.second, expected.second) << drawing_of(grid);
    EXPECT_NEAR(found.first, expected.first, 1e-4) << drawing_of(grid);
    apart += expected.second < 4 ? 1 : 0;
  }
  EXPECT_GT(apart, 2) << "worlds in pieces";
}

TEST(TravelRegions, AcrossABorderLeadsAPathOfFreeStepsOfThatLength) {
  const OccupancyGrid grid = drawn({"....#....", "....#....", ".........", "....#...."});
  const DiscLattice lattice(DistanceField(grid, UnknownPolicy::avoid), 0.0);
  const TravelRegions regions(lattice, std::vector<Cell>{{0, 3}, {8, 3}, {8, 3}, {4, 3}});
  ASSERT_EQ(regions.borders().size(), 2U) << "none with the place inside a wall";
  EXPECT_EQ(regions.borders()[0].length_m, 0.0) << "two on one cell";
  EXPECT_EQ(regions.path_across(regions.borders()[0]), (std::vector<Cell>{{8, 3}}));
  const TravelRegions::Border& border = regions.borders()[1];
  EXPECT_EQ(border.first, 0U);
  EXPECT_EQ(border.second, 1U);
  const std::vector<Cell> path = regions.path_across(border);
  EXPECT_EQ(path.front(), (Cell{0, 3}));
  EXPECT_EQ(path.back(), (Cell{8, 3}));
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Cell by = path[i] - path[i - 1];
    const auto step = std::ranges::find(DiscLattice::kSteps, by) - std::begin(DiscLattice::kSteps);
    ASSERT_LT(step, 8);
    EXPECT_TRUE(lattice.may_step(path[i - 1], static_cast<int>(step)));
    length_m += 0.1 * std::hypot(by.x, by.y);
  }
  EXPECT_NEAR(length_m, border.length_m, 1e-5);
  EXPECT_NEAR(length_m, 0.4 + 0.4 * std::sqrt(2.0), 1e-5) << "no corner is cut";
}

}  // namespace
}  // namespace cairn
