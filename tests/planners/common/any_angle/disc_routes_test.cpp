#include "planners/common/any_angle/disc_routes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <utility>

#include "planners/common/disc_space/routes.hpp"
#include "tests/planners/common/any_angle/plain_paths.hpp"
#include "tests/planners/drawn_world.hpp"

namespace cairn {
namespace {

using test::drawing_of;
using test::drawn_world;
using test::DrawnWorld;
using test::OpenCells;
using test::random_cells;

OccupancyGrid grid_of(const OpenCells& cells, double cell_m, const Point& origin_m) {
  OccupancyGrid grid(cell_m, 4.0, origin_m);
  for (int y = cells.box.min.y; y < cells.box.max.y; ++y)
    for (int x = cells.box.min.x; x < cells.box.max.x; ++x)
      grid.set_log_odds({x, y}, static_cast<LogOdds>(cells.is_open(x, y) ? -1000 : 1000));
  return grid;
}

DiscRoutes routes_on(const OccupancyGrid& grid, double radius_m) {
  return {std::make_shared<const DiscSpace>(grid, GroundRules{}), radius_m};
}

std::string text_of(const std::vector<Point>& route) {
  std::string text;
  for (const Point& p : route) text += "(" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ") ";
  return text;
}

// The first segment that the re-check refuses, or 0.
std::size_t refused_segment(const OccupancyGrid& grid, const std::vector<Point>& route, double radius_m) {
  for (std::size_t i = 1; i < route.size(); ++i)
    if (!sweep_is_free(grid, {}, route[i - 1], route[i], radius_m)) return i;
  return 0;
}

TEST(DiscRoutes, APointsRouteIsTheShortestAndTouchesNothing) {
  std::mt19937_64 random(21);
  for (int round = 0; round < 24; ++round) {
    const OpenCells cells = random_cells(random, 24, 20, 0.1 + 0.08 * (round % 4));
    const OccupancyGrid grid = grid_of(cells, 0.05, {-0.3, 0.7});
    const DiscRoutes routes = routes_on(grid, kMinRadius_m);
    for (int pair = 0; pair < 8; ++pair) {
      const Cell a{static_cast<int>(random() % 24), static_cast<int>(random() % 20)};
      const Cell b{static_cast<int>(random() % 24), static_cast<int>(random() % 20)};
      if (!cells.is_open(a.x, a.y) || !cells.is_open(b.x, b.y)) continue;
      const DiscRoute found = routes.route(grid.centre_of(a), grid.centre_of(b), Budget{});
      const double wanted =
          0.05 * test::plain_shortest_length(cells, Point(a.x + 0.5, a.y + 0.5), Point(b.x + 0.5, b.y + 0.5));
      ASSERT_EQ(found.impossible, std::isinf(wanted)) << drawing_of(cells);
      if (found.impossible) continue;
      EXPECT_NEAR(found.length_lower_bound_m, wanted, 1e-9);
      EXPECT_NEAR(length_of(found.route), wanted, 1e-4);
      ASSERT_EQ(refused_segment(grid, found.route, 0.0), 0U) << text_of(found.route) << drawing_of(cells);
    }
  }
}

TEST(DiscRoutes, ADiscsRouteFitsAndIsNotShorterThanItMustBe) {
  std::mt19937_64 random(22);
  int found_some = 0;
  for (int round = 0; round < 60; ++round) {
    const OpenCells cells = random_cells(random, 30, 30, 0.04 + 0.03 * (round % 4));
    const OccupancyGrid grid = grid_of(cells, 0.1, {5.0, -2.0});
    const double radius_m = 0.04 + 0.035 * (round % 5);
    const DiscRoutes routes = routes_on(grid, radius_m + kMinRadius_m);
    for (int pair = 0; pair < 8; ++pair) {
      const Point a = grid.centre_of({static_cast<int>(random() % 30), static_cast<int>(random() % 30)});
      const Point b = grid.centre_of({static_cast<int>(random() % 30), static_cast<int>(random() % 30)});
      if (!routes.space().fits(a, radius_m + kMinRadius_m) || !routes.space().fits(b, radius_m + kMinRadius_m))
        continue;
      const DiscRoute found = routes.route(a, b, Budget{});
      if (found.route.empty()) continue;
      ++found_some;
      EXPECT_EQ(found.route.front(), a);
      EXPECT_EQ(found.route.back(), b);
      EXPECT_GE(length_of(found.route), found.length_lower_bound_m - 1e-9);
      ASSERT_EQ(refused_segment(grid, found.route, radius_m), 0U) << text_of(found.route) << drawing_of(cells);
    }
  }
  EXPECT_GT(found_some, 100);
}

TEST(DiscRoutes, ImpossibleIsNeverSaidOfWhatAFinerLatticeReaches) {
  std::mt19937_64 random(23);
  for (int round = 0; round < 40; ++round) {
    const OpenCells cells = random_cells(random, 16, 16, 0.12);
    const OccupancyGrid grid = grid_of(cells, 0.1, {0.0, 0.0});
    const double radius_m = 0.03 + 0.02 * (round % 5);
    const DiscRoutes routes = routes_on(grid, radius_m);
    // Cells of a ninth whose centres hold the disc, joined over sides: a subset of where it can go.
    const DiscSpace fine = routes.space().refined(9);
    OpenCells standing{fine.field().box(), {}};
    for (int y = standing.box.min.y; y < standing.box.max.y; ++y)
      for (int x = standing.box.min.x; x < standing.box.max.x; ++x)
        standing.open.push_back(fine.fits(fine.field().centre_of({x, y}), radius_m) ? 1 : 0);
    const CellMesh mesh(standing.box, standing.open);
    for (int pair = 0; pair < 200; ++pair) {
      const Cell a{static_cast<int>(random() % 144), static_cast<int>(random() % 144)};
      const Cell b{static_cast<int>(random() % 144), static_cast<int>(random() % 144)};
      if (mesh.rectangle_of(a) == CellMesh::kNone || mesh.rectangle_of(b) == CellMesh::kNone) continue;
      if (mesh.part_of(mesh.rectangle_of(a)) != mesh.part_of(mesh.rectangle_of(b))) continue;
      EXPECT_TRUE(routes.may_reach(fine.field().centre_of(a), fine.field().centre_of(b))) << drawing_of(cells);
    }
  }
}

TEST(DiscRoutes, AFinerLatticeIsTriedOnlyForRoutesMoreDoubtfulThanAsked) {
  std::mt19937_64 random(24);
  int better = 0;
  for (int round = 0; round < 20; ++round) {
    const OccupancyGrid grid = grid_of(random_cells(random, 20, 20, 0.06), 0.1, {0.0, 0.0});
    const DiscRoutes routes = routes_on(grid, 0.13 + 0.03 * (round % 4));
    for (int pair = 0; pair < 6; ++pair) {
      const Point a = grid.centre_of({static_cast<int>(random() % 20), static_cast<int>(random() % 20)});
      const Point b = grid.centre_of({static_cast<int>(random() % 20), static_cast<int>(random() % 20)});
      if (!routes.space().fits(a, routes.radius_m()) || !routes.space().fits(b, routes.radius_m())) continue;
      const DiscRoute coarse = routes.coarse_route(a, b, Budget{});
      const DiscRoute any_ratio = routes.route(a, b, Budget{}, 1e9);
      const DiscRoute doubted = routes.route(a, b, Budget{}, 0.0);
      if (coarse.route.empty()) {
        EXPECT_EQ(any_ratio.route, doubted.route);
        continue;
      }
      EXPECT_EQ(any_ratio.route, coarse.route);
      EXPECT_EQ(any_ratio.length_lower_bound_m, coarse.length_lower_bound_m);
      EXPECT_LE(length_of(doubted.route), length_of(coarse.route));
      better += doubted.length_lower_bound_m > coarse.length_lower_bound_m * (1.0 + 1e-9);
    }
  }
  EXPECT_GT(better, 3);
}

TEST(DiscRoutes, ADoorHardlyWiderThanTheDiscIsPassed) {
  // Door and disc in every ratio down to a hair.
  const DrawnWorld world = drawn_world(
      "#########\n"
      "#...#...#\n"
      "#.A...B.#\n"
      "#...#...#\n"
      "#########\n",
      0.1, 4);
  for (const double radius_m : {0.05, 0.1, 0.15, 0.18, 0.19}) {
    const DiscRoute found = routes_on(world.grid, radius_m).route(world.places.at('A'), world.places.at('B'), Budget{});
    ASSERT_FALSE(found.route.empty()) << "a door of 0.4 m, a radius of " << radius_m;
    EXPECT_EQ(refused_segment(world.grid, found.route, radius_m - 1e-6), 0U);
  }
  EXPECT_FALSE(routes_on(world.grid, 0.26).may_reach(world.places.at('A'), world.places.at('B')));
}

TEST(DiscRoutes, ARobotWiderThanTheGapCannotPass) {
  const DrawnWorld world = drawn_world(
      "#################\n"
      "#.......#.......#\n"
      "#.......#.......#\n"
      "#...A...#...B...#\n"
      "#.......#.......#\n"
      "#.......#.......#\n"
      "#...............#\n"
      "#...............#\n"
      "#...............#\n"
      "#################\n");
  const Point from = world.places.at('A');
  const Point to = world.places.at('B');
  const DiscRoute found = routes_on(world.grid, 0.149).route(from, to, Budget{});
  ASSERT_FALSE(found.route.empty()) << "a gap of 0.30 m";
  EXPECT_EQ(refused_segment(world.grid, found.route, 0.149 - 1e-6), 0U);
  EXPECT_LT(length_of(routes_on(world.grid, 0.1).route(from, to, Budget{}).route), 1.3);
  EXPECT_TRUE(routes_on(world.grid, 0.16).route(from, to, Budget{}).route.empty());
}

TEST(DiscRoutes, ADiscOfAQuarterCellPassesCorridorsOneCellWide) {
  const DrawnWorld world = drawn_world(
      "#######\n"
      "#A....#\n"
      "#####.#\n"
      "#.....#\n"
      "#.#####\n"
      "#....B#\n"
      "#######\n",
      1.0);
  const DiscRoutes routes = routes_on(world.grid, 0.3);
  const DiscRoute found = routes.route(world.places.at('A'), world.places.at('B'), Budget{});
  ASSERT_FALSE(found.route.empty());
  EXPECT_EQ(refused_segment(world.grid, found.route, 0.3 - 1e-6), 0U);
  EXPECT_LT(length_of(found.route), 1.05 * found.length_lower_bound_m + 0.5);
}

TEST(DiscRoutes, CellsBetweenAreThoseJoinedThatARouteOfTheLengthMayPass) {
  std::mt19937_64 random(33);
  for (int round = 0; round < 12; ++round) {
    const OpenCells cells = random_cells(random, 24, 20, 0.1 + 0.08 * (round % 4));
    const OccupancyGrid grid = grid_of(cells, 0.05, {-0.3, 0.7});
    const DiscRoutes routes = routes_on(grid, kMinRadius_m);
    const Point from = grid.centre_of(Cell{static_cast<int>(random() % 24), static_cast<int>(random() % 20)});
    const Point to = grid.centre_of(Cell{static_cast<int>(random() % 24), static_cast<int>(random() % 20)});
    for (const double max_m : {0.503, 0.907, std::numeric_limits<double>::infinity()}) {
      const auto is_wanted = [&](Cell cell) {
        const Point centre = grid.centre_of(cell);
        const auto off_m = [&](const Point& end) {
          return ((end - centre).cwiseAbs() - Point(0.025, 0.025)).cwiseMax(0.0).norm();
        };
        return cells.is_open(cell.x, cell.y) && routes.may_reach(from, centre) && off_m(from) + off_m(to) <= max_m;
      };
      const NumberedCells found = routes.cells_between(from, to, max_m);
      std::size_t wanted = 0;
      for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 24; ++x) wanted += is_wanted({x, y}) ? 1U : 0U;
      EXPECT_EQ(found.size(), wanted) << max_m << drawing_of(cells);
      std::set<std::pair<int, int>> seen;
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_TRUE(is_wanted(found[i])) << max_m << drawing_of(cells);
        EXPECT_TRUE(seen.emplace(found[i].x, found[i].y).second);
      }
    }
  }
}

}  // namespace
}  // namespace cairn
