#include "maps/grid/travel_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

#include "tests/maps/drawn_grid.hpp"

namespace cairn {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The field's path to a letter as a drawing of stars.
std::vector<std::string> path_drawn(const Drawing& drawing, const TravelField& field, char to) {
  const CellBox box = drawing.grid.bounds();
  std::vector<std::string> rows(static_cast<std::size_t>(box.height()),
                                std::string(static_cast<std::size_t>(box.width()), '.'));
  for (int y = 0; y < box.height(); ++y)
    for (int x = 0; x < box.width(); ++x)
      if (drawing.space.is_blocked({x, y}))
        rows[static_cast<std::size_t>(box.height() - 1 - y)][static_cast<std::size_t>(x)] = '#';
  for (const Cell c : field.path_to(drawing.grid.cell_at(drawing.at_m.at(to))))
    rows[static_cast<std::size_t>(box.height() - 1 - c.y)][static_cast<std::size_t>(c.x)] = '*';
  return rows;
}

TEST(TravelField, GoesRoundAWall) {
  const Drawing d = read_drawing({".......",  //
                                  "...#...",  //
                                  ".a.#.b.",  //
                                  "...#...",  //
                                  "...#..."});
  const TravelField field(d.space, d.at_m.at('a'), 0.0);
  EXPECT_EQ(path_drawn(d, field, 'b'), (std::vector<std::string>{"..***..",  //
                                                                 ".*.#*..",  //
                                                                 ".*.#.*.",  //
                                                                 "...#...",  //
                                                                 "...#..."}));
  EXPECT_FLOAT_EQ(field.cost_m(d.grid.cell_at(d.at_m.at('b'))), static_cast<float>(0.1 * (4.0 + 2.0 * std::sqrt(2.0))));
}

TEST(TravelField, CutsNoCorners) {
  const Drawing d = read_drawing({"..b",  //
                                  ".#.",  //
                                  "a.."});
  const TravelField field(d.space, d.at_m.at('a'), 0.0);
  EXPECT_FLOAT_EQ(field.cost_m({2, 2}), 0.4F);  // along the edges, not diagonally past the block
}

TEST(TravelField, DoesNotSlipBetweenTwoDiagonalBlocks) {
  const Drawing d = read_drawing({"##b",  //
                                  "#.#",  //
                                  "a##"});
  const TravelField field(d.space, d.at_m.at('a'), 0.0);
  EXPECT_TRUE(field.reaches({0, 0}));
  EXPECT_FALSE(field.reaches({1, 1}));
  EXPECT_FALSE(field.reaches({2, 2}));
  EXPECT_TRUE(field.path_to({2, 2}).empty());
}

TEST(TravelField, KeepsItsClearance) {
  const Drawing d = read_drawing({"#########",  //
                                  "#.......#",  //
                                  "#.......#",  //
                                  "#a..#..b#",  //
                                  "#.......#",  //
                                  "#########"});
  EXPECT_TRUE(TravelField(d.space, d.at_m.at('a'), 0.1).reaches({7, 2}));
  EXPECT_FALSE(TravelField(d.space, d.at_m.at('a'), 0.2).reaches({7, 2}));
}

TEST(TravelField, TakesTheClearanceItselfAsEnough) {
  const Drawing d = read_drawing({"#####",  //
                                  "#...#",  //
                                  "#a.b#",  //
                                  "#...#",  //
                                  "#####"},
                                 0.05);
  for (const double steps : {1.0, 2.0}) {
    const TravelField field(d.space, d.at_m.at('a'), steps * 0.05);
    EXPECT_TRUE(field.reaches({2, 2})) << steps;
  }
}

TEST(TravelField, CountsTheStartAsFree) {
  const Drawing d = read_drawing({".....",  //
                                  "..#..",  //
                                  "....."});
  const TravelField inside_a_wall(d.space, d.grid.centre_of({2, 1}), 0.0);
  EXPECT_EQ(inside_a_wall.cost_m({2, 1}), 0.0F);
  EXPECT_TRUE(inside_a_wall.reaches({0, 0}));
  EXPECT_EQ(inside_a_wall.path_to({2, 1}), (std::vector<Cell>{{2, 1}}));
}

TEST(TravelField, ReachesNothingFromOutsideItsBox) {
  const Drawing d = read_drawing({"..", ".."});
  const TravelField field(d.space, {50.0, 50.0}, 0.0);
  EXPECT_FALSE(field.reaches({0, 0}));
  EXPECT_EQ(field.cost_m({1000, 1000}), kInfinity);
  EXPECT_TRUE(field.path_to({1000, 1000}).empty());
  EXPECT_FALSE(TravelField(DistanceField(), {0.0, 0.0}, 0.0).reaches({0, 0}));
}

TEST(TravelField, AvoidsDearCells) {
  const Drawing d = read_drawing({".......",  //
                                  ".a...b.",  //
                                  "......."});
  const auto dear_middle = [](Cell c) { return c.y == 1 && c.x == 3 ? 10.0 : 1.0; };
  const TravelField field(d.space, d.at_m.at('a'), 0.0, dear_middle);
  EXPECT_EQ(path_drawn(d, field, 'b'), (std::vector<std::string>{".......",  //
                                                                 ".*..**.",  //
                                                                 "..**..."}));
  const TravelField back(d.space, d.at_m.at('b'), 0.0, dear_middle);
  EXPECT_FLOAT_EQ(field.cost_m(d.grid.cell_at(d.at_m.at('b'))), back.cost_m(d.grid.cell_at(d.at_m.at('a'))));
}

TEST(TravelField, RefusesWeightsBelowOne) {
  const Drawing d = read_drawing({"...", "..."});
  for (const double weight : {0.5, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(TravelField(d.space, {0.05, 0.05}, 0.0, [weight](Cell) { return weight; }), std::invalid_argument);
}

// Relaxes every edge until nothing gets cheaper.
std::map<Cell, float> bellman_ford(const DistanceField& space, Cell start, float clearance_m, const auto& weight) {
  const auto is_free = [&](Cell c) {
    return c == start || (space.distance_m(c) > 0.0F && space.distance_m(c) >= clearance_m);
  };
  std::map<Cell, float> cost{{start, 0.0F}};
  for (bool cheaper = true; cheaper;) {
    cheaper = false;
    for (const auto& [from, from_cost] : std::map<Cell, float>(cost))
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const Cell to = from + Cell{dx, dy};
          const bool allowed = to != from && is_free(to) && is_free(from + Cell{dx, 0}) && is_free(from + Cell{0, dy});
          if (!allowed) continue;
          const float length =
              static_cast<float>(space.cell_m()) * (dx != 0 && dy != 0 ? std::numbers::sqrt2_v<float> : 1.0F);
          const float step = length * 0.5F * static_cast<float>(weight(from) + weight(to));
          const auto known = cost.find(to);
          if (known != cost.end() && known->second <= from_cost + step) continue;
          cost[to] = from_cost + step;
          cheaper = true;
        }
  }
  return cost;
}

TEST(TravelField, AgreesWithBellmanFordOnRandomMazes) {
  std::mt19937_64 random(31);
  for (int i = 0; i < 60; ++i) {
    const OccupancyGrid grid = random_maze(random);
    const DistanceField space(grid, UnknownPolicy::avoid);
    const Cell start{static_cast<int>(random() % 4) - 8, static_cast<int>(random() % 4) - 4};
    const double clearance_m = i % 3 == 0 ? 0.07 : 0.0;
    const auto weight = [i](Cell c) { return i % 2 == 0 ? 1.0 : 1.0 + 0.25 * ((c.x * 7 + c.y * 3) & 7); };
    const TravelField field(space, grid.centre_of(start), clearance_m, weight);
    const std::map<Cell, float> oracle = bellman_ford(space, start, static_cast<float>(clearance_m), weight);
    const CellBox box = field.box();
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x) {
        const auto found = oracle.find({x, y});
        const float expected = found == oracle.end() ? kInfinity : found->second;
        if (expected == kInfinity) {
          ASSERT_FALSE(field.reaches({x, y})) << drawing_of(grid);
        } else {
          ASSERT_NEAR(field.cost_m({x, y}), expected, 1e-5F * (1.0F + expected)) << x << ", " << y << drawing_of(grid);
        }
      }
  }
}

TEST(TravelField, PathsCostWhatTheFieldSays) {
  std::mt19937_64 random(32);
  for (int i = 0; i < 30; ++i) {
    const OccupancyGrid grid = random_maze(random);
    const DistanceField space(grid, UnknownPolicy::avoid);
    const TravelField field(space, grid.centre_of({-8, -4}), 0.0);
    const CellBox box = field.box();
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x) {
        const std::vector<Cell> path = field.path_to({x, y});
        ASSERT_EQ(path.empty(), !field.reaches({x, y}));
        if (path.empty()) continue;
        ASSERT_EQ(path.front(), (Cell{-8, -4}));
        ASSERT_EQ(path.back(), (Cell{x, y}));
        double length = 0.0;
        for (std::size_t k = 1; k < path.size(); ++k) {
          ASSERT_EQ(distance8(path[k - 1], path[k]), 1);
          length += 0.05 * std::hypot(path[k].x - path[k - 1].x, path[k].y - path[k - 1].y);
        }
        ASSERT_NEAR(field.cost_m({x, y}), length, 1e-4);
      }
  }
}

TEST(TravelField, GivesTiesToTheSmallerRowThenColumn) {
  const Drawing d = read_drawing({".....",  //
                                  ".....",  //
                                  "a.#.b",  //
                                  ".....",  //
                                  "....."});
  const TravelField field(d.space, d.at_m.at('a'), 0.0);
  EXPECT_EQ(path_drawn(d, field, 'b'), (std::vector<std::string>{".....",  //
                                                                 ".....",  //
                                                                 "*.#.*",  //
                                                                 ".***.",  //
                                                                 "....."}));
}

}  // namespace
}  // namespace cairn
