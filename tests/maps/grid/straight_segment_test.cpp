#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "maps/grid/travel_field.hpp"
#include "tests/maps/drawn_grid.hpp"

namespace cairn {
namespace {

TEST(SegmentIsClear, SeesAWallOneCellThick) {
  const Drawing d = read_drawing({"...#...",  //
                                  ".a.#.b.",  //
                                  "...#...",  //
                                  ".c...d."});
  EXPECT_FALSE(segment_is_clear(d.space, d.at_m.at('a'), d.at_m.at('b'), 0.0));
  EXPECT_TRUE(segment_is_clear(d.space, d.at_m.at('c'), d.at_m.at('d'), 0.0));
  EXPECT_TRUE(segment_is_clear(d.space, d.at_m.at('a'), d.at_m.at('c'), 0.0));
  EXPECT_TRUE(segment_is_clear(d.space, d.at_m.at('a'), d.at_m.at('a'), 0.0));
}

TEST(SegmentIsClear, DoesNotSlipThroughACorner) {
  const Drawing d = read_drawing({".#b",  //
                                  ".a#",  //
                                  "..."});
  EXPECT_FALSE(segment_is_clear(d.space, d.at_m.at('a'), d.at_m.at('b'), 0.0));
  EXPECT_FALSE(segment_is_clear(d.space, d.at_m.at('b'), d.at_m.at('a'), 0.0));
  const Drawing one_block = read_drawing({".#b",  //
                                          ".a.",  //
                                          "..."});
  EXPECT_FALSE(segment_is_clear(one_block.space, one_block.at_m.at('a'), one_block.at_m.at('b'), 0.0));
}

TEST(SegmentIsClear, TouchesBothRowsAlongTheirCommonLine) {
  const Drawing d = read_drawing({"..#..",  //
                                  "....."});
  EXPECT_FALSE(segment_is_clear(d.space, {0.05, 0.1}, {0.45, 0.1}, 0.0));
  EXPECT_TRUE(segment_is_clear(d.space, {0.05, 0.099}, {0.45, 0.099}, 0.0));
}

TEST(SegmentIsClear, KeepsTheClearanceAllTheWay) {
  const Drawing d = read_drawing({".....",  //
                                  ".....",  //
                                  "a...b",  //
                                  ".....",  //
                                  "....."});
  EXPECT_TRUE(segment_is_clear(d.space, d.at_m.at('a'), d.at_m.at('b'), 0.1));
  EXPECT_FALSE(segment_is_clear(d.space, d.at_m.at('a'), d.at_m.at('b'), 0.11));
}

TEST(SegmentIsClear, IsFalseWhereTheSegmentLeavesTheBoxOrIsNotFinite) {
  const Drawing d = read_drawing({"...", "..."});
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
    ASSERT_EQ(segment_is_clear(space, a, b, clearance_m), expected)
        << a.transpose() << " to " << b.transpose() << drawing_of(grid);
    ASSERT_EQ(segment_is_clear(space, b, a, clearance_m), expected);
    clear += expected;
  }
  EXPECT_GT(clear, 500);
  EXPECT_LT(clear, 2500);
}

TEST(Shortened, KeepsOnlyTheCornersItNeeds) {
  const Drawing d = read_drawing({".........",  //
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
  const Drawing d = read_drawing({"...", "..."});
  EXPECT_TRUE(shortened(d.space, {}, 0.0).empty());
  EXPECT_EQ(shortened(d.space, {{0.05, 0.05}}, 0.0).size(), 1U);
  EXPECT_EQ(shortened(d.space, {{0.05, 0.05}, {0.25, 0.15}}, 0.0).size(), 2U);
}

}  // namespace
}  // namespace cairn
