#include "maps/travel_field.hpp"

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

struct Drawing {
  OccupancyGrid grid;
  DistanceField space;
  std::map<char, Point> at_m;  // centres of the lettered cells, which are free
};

Drawing read(std::vector<std::string> rows, double cell_m = 0.1) {
  std::map<char, Cell> letters;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t x = 0; x < rows[i].size(); ++x)
      if (std::isalpha(static_cast<unsigned char>(rows[i][x]))) {
        letters[rows[i][x]] = {static_cast<int>(x), static_cast<int>(rows.size() - 1 - i)};
        rows[i][x] = '.';
      }
  Drawing drawing{drawn(rows, cell_m), {}, {}};
  drawing.space = DistanceField(drawing.grid, UnknownPolicy::avoid);
  for (const auto& [letter, cell] : letters) drawing.at_m[letter] = drawing.grid.centre_of(cell);
  return drawing;
}

// The field's path to a letter as a drawing of stars.
std::vector<std::string> path_drawn(const Drawing& drawing, const TravelField& field, char to) {
  const CellBox box = drawing.grid.bounds();
  std::vector<std::string> rows(static_cast<std::size_t>(box.height()),
                                std::string(static_cast<std::size_t>(box.width()), '.'));
  for (int y = 0; y < box.height(); ++y)
    for (int x = 0; x < box.width(); ++x)
      if (drawing.space.is_blocked({x, y})) rows[static_cast<std::size_t>(box.height() - 1 - y)][static_cast<std::size_t>(x)] = '#';
  for (const Cell c : field.path_to(drawing.grid.cell_at(drawing.at_m.at(to))))
    rows[static_cast<std::size_t>(box.height() - 1 - c.y)][static_cast<std::size_t>(c.x)] = '*';
  return rows;
}

TEST(TravelField, GoesRoundAWall) {
  const Drawing d = read({".......",  //
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
  const Drawing d = read({"..b",  //
                          ".#.",  //
                          "a.."});
  const TravelField field(d.space, d.at_m.at('a'), 0.0);
  EXPECT_FLOAT_EQ(field.cost_m({2, 2}), 0.4F);  // along the edges, not diagonally past the block
}

TEST(TravelField, DoesNotSlipBetweenTwoDiagonalBlocks) {
  const Drawing d = read({"##b",  //
                          "#.#",  //
                          "a##"});
  const TravelField field(d.space, d.at_m.at('a'), 0.0);
  EXPECT_TRUE(field.reaches({0, 0}));
  EXPECT_FALSE(field.reaches({1, 1}));
  EXPECT_FALSE(field.reaches({2, 2}));
  EXPECT_TRUE(field.path_to({2, 2}).empty());
}

TEST(TravelField, KeepsItsClearance) {
  const Drawing d = read({"#########",  //
                          "#.......#",  //
                          "#.......#",  //
                          "#a..#..b#",  //
                          "#.......#",  //
                          "#########"});
  EXPECT_TRUE(TravelField(d.space, d.at_m.at('a'), 0.1).reaches({7, 2}));
  EXPECT_FALSE(TravelField(d.space, d.at_m.at('a'), 0.2).reaches({7, 2}));
}

TEST(TravelField, TakesTheClearanceItselfAsEnough) {
  const Drawing d = read({"#####",  //
                          "#...#",  //
                          "#a.b#",  //
                          "#...#",  //
                          "#####"}, 0.05);
  for (const double steps : {1.0, 2.0}) {
    const TravelField field(d.space, d.at_m.at('a'), steps * 0.05);
    EXPECT_TRUE(field.reaches({2, 2})) << steps;
  }
}

TEST(TravelField, CountsTheStartAsFree) {
  const Drawing d = read({".....",  //
                          "..#..",  //
                          "....."});
  const TravelField inside_a_wall(d.space, d.grid.centre_of({2, 1}), 0.0);
  EXPECT_EQ(inside_a_wall.cost_m({2, 1}), 0.0F);
  EXPECT_TRUE(inside_a_wall.reaches({0, 0}));
  EXPECT_EQ(inside_a_wall.path_to({2, 1}), (std::vector<Cell>{{2, 1}}));
}

TEST(TravelField, ReachesNothingFromOutsideItsBox) {
  const Drawing d = read({"..", ".."});
  const TravelField field(d.space, {50.0, 50.0}, 0.0);
  EXPECT_FALSE(field.reaches({0, 0}));
  EXPECT_EQ(field.cost_m({1000, 1000}), kInfinity);
  EXPECT_TRUE(field.path_to({1000, 1000}).empty());
  EXPECT_FALSE(TravelField(DistanceField(), {0.0, 0.0}, 0.0).reaches({0, 0}));
}

TEST(TravelField, AvoidsDearCells) {
  const Drawing d = read({".......",  //
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
  const Drawing d = read({"...", "..."});
  for (const double weight : {0.5, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(TravelField(d.space, {0.05, 0.05}, 0.0, [weight](Cell) { return weight; }), std::invalid_argument);
}

OccupancyGrid random_maze(std::mt19937_64& random) {
  OccupancyGrid grid(0.05);
  const int width = 4 + static_cast<int>(random() % 24);
  const int height = 4 + static_cast<int>(random() % 24);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) grid.set_log_odds({x - 9, y - 5}, random() % 4 == 0 ? LogOdds{900} : LogOdds{-900});
  return grid;
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
          const float length = static_cast<float>(space.cell_m()) *
                               (dx != 0 && dy != 0 ? std::numbers::sqrt2_v<float> : 1.0F);
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
  const Drawing d = read({".....",  //
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



TEST(SegmentIsClear, SeesAWallOneCellThick) {
  const Drawing d = read({"...#...",  //
                          ".a.#.b.",  //
                          "...#...",  //
                          ".c...d."});
  EXPECT_FALSE(segment_is_clear(d.space, d.at_m.at('a'), d.at_m.at('b'), 0.0));
  EXPECT_TRUE(segment_is_clear(d.space, d.at_m.at('c'), d.at_m.at('d'), 0.0));
  EXPECT_TRUE(segment_is_clear(d.space, d.at_m.at('a'), d.at_m.at('c'), 0.0));
  EXPECT_TRUE(segment_is_clear(d.space, d.at_m.at('a'), d.at_m.at('a'), 0.0));
}

TEST(SegmentIsClear, DoesNotSlipThroughACorner) {
  const Drawing d = read({".#b",  //
                          ".a#",  //
                          "..."});
  EXPECT_FALSE(segment_is_clear(d.space, d.at_m.at('a'), d.at_m.at('b'), 0.0));
  EXPECT_FALSE(segment_is_clear(d.space, d.at_m.at('b'), d.at_m.at('a'), 0.0));
  const Drawing one_block = read({".#b",  //
                                  ".a.",  //
                                  "..."});
  EXPECT_FALSE(segment_is_clear(one_block.space, one_block.at_m.at('a'), one_block.at_m.at('b'), 0.0));
}

TEST(SegmentIsClear, TouchesBothRowsAlongTheirCommonLine) {
  const Drawing d = read({"..#..",  //
                          "....."});
  EXPECT_FALSE(segment_is_clear(d.space, {0.05, 0.1}, {0.45, 0.1}, 0.0));
  EXPECT_TRUE(segment_is_clear(d.space, {0.05, 0.099}, {0.45, 0.099}, 0.0));
}

TEST(SegmentIsClear, KeepsTheClearanceAllTheWay) {
  const Drawing d = read({".....",  //
                          ".....",  //
                          "a...b",  //
                          ".....",  //
                          "....."});
  EXPECT_TRUE(segment_is_clear(d.space, d.at_m.at('a'), d.at_m.at('b'), 0.1));
  EXPECT_FALSE(segment_is_clear(d.space, d.at_m.at('a'), d.at_m.at('b'), 0.11));
}

TEST(SegmentIsClear, IsFalseWhereTheSegmentLeavesTheBoxOrIsNotFinite) {
  const Drawing d = read({"...", "..."});
  const Point inside = d.grid.centre_of({1, 0});
  EXPECT_FALSE(segment_is_clear(d.space, inside, {5.0, 0.05}, 0.0));
  EXPECT_FALSE(segment_is_clear(d.space, {-1e300, 0.05}, inside, 0.0));
  EXPECT_FALSE(segment_is_clear(d.space, inside, {std::nan(""), 0.05}, 0.0));
  EXPECT_FALSE(segment_is_clear(DistanceField(), inside, inside, 0.0));
}

// Every cell whose closed square the segment meets, by clipping it against each square.
bool naive_clear(const DistanceField& space, const Point& from, const Point& to, double clearance_m) {
  const CellBox box = space.box();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) {
      const Point low = space.centre_of({x, y}) - Point::Constant(space.cell_m() / 2.0);
      double enter = 0.0;
      double leave = 1.0;
      for (int axis = 0; axis < 2; ++axis) {
        const double d = to[axis] - from[axis];
        const double a = low[axis] - from[axis];
        const double b = a + space.cell_m();
        if (d == 0.0 && (a > 0.0 || b < 0.0)) enter = 2.0;
        if (d == 0.0) continue;
        enter = std::max(enter, std::min(a / d, b / d));
        leave = std::min(leave, std::max(a / d, b / d));
      }
      const float distance = space.distance_m({x, y});
      if (enter <= leave && (distance <= 0.0F || distance < static_cast<float>(clearance_m))) return false;
    }
  return true;
}

TEST(SegmentIsClear, AgreesWithClippingAgainstEveryCell) {
  std::mt19937_64 random(33);
  int clear = 0;
  for (int i = 0; i < 3000; ++i) {
    OccupancyGrid grid(0.05);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) grid.set_log_odds({x - 8, y - 8}, random() % 20 == 0 ? LogOdds{900} : LogOdds{-900});
    const DistanceField space(grid, UnknownPolicy::avoid);
    std::uniform_real_distribution<double> metres(-0.4, 0.4);
    const Point a{metres(random), metres(random)};
    const Point b{metres(random), i % 10 == 0 ? a.y() : metres(random)};
    const double clearance_m = i % 4 == 0 ? 0.08 : 0.0;
    const bool expected = naive_clear(space, a, b, clearance_m);
    ASSERT_EQ(segment_is_clear(space, a, b, clearance_m), expected) << a.transpose() << " to " << b.transpose() << drawing_of(grid);
    ASSERT_EQ(segment_is_clear(space, b, a, clearance_m), expected);
    clear += expected;
  }
  EXPECT_GT(clear, 500);
  EXPECT_LT(clear, 2500);
}



TEST(Shortened, KeepsOnlyTheCornersItNeeds) {
  const Drawing d = read({".........",  //
                          "....#....",  //
                          "a...#...b",  //
                          "....#....",  //
                          "....#...."});
  const TravelField field(d.space, d.at_m.at('a'), 0.0);
  std::vector<Point> path;
  for (const Cell c : field.path_to(d.grid.cell_at(d.at_m.at('b')))) path.push_back(d.grid.centre_of(c));
  const std::vector<Point> corners = shortened(d.space, path, 0.0);
  EXPECT_EQ(corners.front(), path.front());
  EXPECT_EQ(corners.back(), path.back());
  EXPECT_EQ(corners.size(), 3U);  // the ends and one bend above the wall
}

TEST(Shortened, IsClearNoLongerAndCannotBeShortenedAgain) {
  std::mt19937_64 random(34);
  int compared = 0;
  for (int i = 0; i < 40; ++i) {
    const OccupancyGrid grid = random_maze(random);
    const DistanceField space(grid, UnknownPolicy::avoid);
    const Cell start{-8, -4};
    if (space.is_blocked(start)) continue;
    const TravelField field(space, grid.centre_of(start), 0.0);
    const CellBox box = field.box();
    for (int y = box.min.y; y < box.max.y; y += 3)
      for (int x = box.min.x; x < box.max.x; x += 3) {
        std::vector<Point> path;
        for (const Cell c : field.path_to({x, y})) path.push_back(grid.centre_of(c));
        if (path.empty()) continue;
        const std::vector<Point> corners = shortened(space, path, 0.0);
        ASSERT_EQ(corners.front(), path.front());
        ASSERT_EQ(corners.back(), path.back());
        for (std::size_t k = 1; k < corners.size(); ++k)
          ASSERT_TRUE(segment_is_clear(space, corners[k - 1], corners[k], 0.0)) << drawing_of(grid);
        for (std::size_t k = 2; k < corners.size(); ++k)
          ASSERT_FALSE(segment_is_clear(space, corners[k - 2], corners[k], 0.0)) << drawing_of(grid);
        ++compared;
      }
  }
  EXPECT_GT(compared, 100);
}

TEST(Shortened, LeavesShortPathsAlone) {
  const Drawing d = read({"...", "..."});
  EXPECT_TRUE(shortened(d.space, {}, 0.0).empty());
  EXPECT_EQ(shortened(d.space, {{0.05, 0.05}}, 0.0).size(), 1U);
  EXPECT_EQ(shortened(d.space, {{0.05, 0.05}, {0.25, 0.15}}, 0.0).size(), 2U);
}

}  // namespace
}  // namespace cairn
