#include "planners/common/disc_space/routes.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "tests/planners/drawn_world.hpp"

namespace cairn {
namespace {

using test::drawn_world;

const char* const kTwoRooms =
    "#################\n"
    "#.......#.......#\n"
    "#.......#.......#\n"
    "#.A.....#.....B.#\n"
    "#.......#.......#\n"
    "#.......#.......#\n"
    "#...............#\n"
    "#...............#\n"
    "#...............#\n"
    "#################\n";

TEST(Routes, TheRecheckKnowsTheEscapeAndNothingElse) {
  const auto world = drawn_world(kTwoRooms);
  const DiscSpace space(world.grid, {});
  const Point start(0.15, 0.55);
  const auto escape = escape_from(world.grid, space, start, 0.12, 0.2);
  ASSERT_TRUE(escape);
  const std::vector<Point> route{start, escape->to, {0.5, 0.55}};
  EXPECT_TRUE(route_is_free(world.grid, {}, route, 0.12, escape));
  EXPECT_FALSE(route_is_free(world.grid, {}, route, 0.12)) << "without the escape";
  EXPECT_FALSE(route_is_free(world.grid, {}, {start, {0.5, 0.55}}, 0.12, escape)) << "another first segment";
  EXPECT_FALSE(route_is_free(world.grid, {}, {}, 0.12));
}

TEST(Routes, StraightenedKeepsTheEndsAndTheFirstPointsAskedFor) {
  const auto world = drawn_world(kTwoRooms);
  const DiscSpace space(world.grid, {});
  const std::vector<Point> route{{0.25, 0.25}, {0.35, 0.35}, {0.45, 0.25}, {0.65, 0.25}};
  EXPECT_EQ(straightened(space, route, 0.1), (std::vector<Point>{route.front(), route.back()}));
  EXPECT_EQ(straightened(space, route, 0.1, 2), (std::vector<Point>{route[0], route[1], route[3]}));
}

// Free ground with a box of 40 x 40 occupied cells, [0, 2] x [0, 2] m, in the middle.
OccupancyGrid box_grid() {
  OccupancyGrid grid(0.05);
  for (int y = -80; y < 120; ++y)
    for (int x = -80; x < 120; ++x) {
      const bool box = x >= 0 && x < 40 && y >= 0 && y < 40;
      grid.set_log_odds({x, y}, box ? LogOdds{900} : LogOdds{-900});
    }
  return grid;
}

TEST(Routes, TightenedComesNearToTheTangentsRoundACorner) {
  const OccupancyGrid grid = box_grid();
  const DiscSpace space(grid, {});
  constexpr double kRadius_m = 0.25;
  // Round the corner (0, 0): tangents of the circle round it, and the arc between them.
  const Point from(-0.9, 1.7);
  const Point to(1.3, -0.6);
  const auto tangent_m = [](const Point& p) { return std::sqrt(p.squaredNorm() - kRadius_m * kRadius_m); };
  const auto tangent_rad = [](const Point& p) { return std::acos(kRadius_m / p.norm()); };
  const double between_rad = 2.0 * std::numbers::pi - std::acos(from.dot(to) / (from.norm() * to.norm()));
  const double arc_m = kRadius_m * (between_rad - tangent_rad(from) - tangent_rad(to));
  const double best_m = tangent_m(from) + arc_m + tangent_m(to);
  for (const Point& corner : {Point(-0.9, -0.6), Point(-1.5, -1.4), Point(-0.3, -0.3)}) {
    const std::vector<Point> route{from, corner, to};
    const std::vector<Point> tight = tightened(space, route, kRadius_m);
    EXPECT_GE(length_of(tight), best_m - 1e-9);
    EXPECT_LE(length_of(tight), 1.01 * best_m) << text_of(corner) << ", " << tight.size() << " points";
    EXPECT_LT(length_of(tight), length_of(route));
    EXPECT_TRUE(route_is_free(grid, {}, tight, kRadius_m));
    EXPECT_EQ(tightened(space, route, kRadius_m), tight);
  }
}

TEST(Routes, TightenedIsNeverLongerAndNeverTouches) {
  int shorter = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    OccupancyGrid grid(0.1);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) grid.set_log_odds({x, y}, random() % 12 == 0 ? LogOdds{900} : LogOdds{-900});
    const DiscSpace space(grid, {});
    const double radius_m = seed % 3 == 0 ? 0.0 : 0.12;
    std::uniform_real_distribution<double> at(0.2, 3.8);
    std::vector<Point> route;
    for (int tries = 0; tries < 4000 && route.size() < 12; ++tries) {
      const Point next(at(random), at(random));
      if (space.fits_along(route.empty() ? next : route.back(), next, radius_m)) route.push_back(next);
    }
    const std::size_t keep = 1 + seed % 2;
    if (route.size() <= keep) continue;
    const std::vector<Point> tight = tightened(space, route, radius_m, keep);
    ASSERT_GE(tight.size(), keep + 1);
    for (std::size_t i = 0; i < keep; ++i) EXPECT_EQ(tight[i], route[i]);
    EXPECT_EQ(tight.back(), route.back());
    EXPECT_LE(length_of(tight), length_of(route) + 1e-12);
    EXPECT_TRUE(route_is_free(grid, {}, tight, radius_m)) << test::drawing_of(grid, poses_along(tight, 0, {}));
    shorter += length_of(tight) < 0.99 * length_of(route);
  }
  EXPECT_GT(shorter, 30);
}

TEST(Routes, TightenedLeavesRoutesWithoutCornersAlone) {
  const DiscSpace space(box_grid(), {});
  EXPECT_TRUE(tightened(space, std::vector<Point>{}, 0.1).empty());
  const std::vector<Point> two{{-0.5, -0.5}, {0.9, -0.5}};
  EXPECT_EQ(tightened(space, two, 0.1), two);
  EXPECT_NEAR(length_of(tightened(space, {two[0], two[0], two[1], two[1]}, 0.1)), length_of(two), 1e-12);
}

TEST(Routes, ShortenedRoutesKnowWhatLiesAcrossParts) {
  const OccupancyGrid grid = box_grid();
  const DiscSpace space(grid, {});
  const auto parts = [](const std::vector<PartedPoint>& route) {
    std::vector<int> in_order;
    for (std::size_t i = 1; i < route.size(); ++i)
      if (in_order.empty() || in_order.back() != route[i].part) in_order.push_back(route[i].part);
    return in_order;
  };
  const std::vector<PartedPoint> open{{{-0.9, 0.0}, 0}, {{-0.9, 0.5}, 3}, {{-0.8, 1.0}, 3}, {{-0.9, 1.5}, 4}};
  EXPECT_EQ(parts(straightened(space, {open[0], open[1], open[2]}, 0.2)), std::vector{3});
  EXPECT_EQ(parts(straightened(space, open, 0.2)), std::vector{kSeveralParts});
  const std::vector<PartedPoint> round{{{-0.2005, 3.0}, 0}, {{-0.2005, -0.2005}, 1}, {{3.0, -0.2005}, 2}};
  EXPECT_EQ(parts(straightened(space, round, 0.2)), (std::vector{1, 2}));
  EXPECT_EQ(parts(tightened(space, round, 0.2)), (std::vector{1, kSeveralParts, 2}))
      << "parts of both legs, and the cut between them";
  EXPECT_EQ(parts(tightened(space, {round[0], {round[1].at, 2}, round[2]}, 0.2)), std::vector{2});
}

TEST(Routes, PosesLookAlongTheRouteAndEndAsTheGoalAsks) {
  const std::vector<Pose2> poses = poses_along({{0, 0}, {1, 0}, {1, 2}}, 3.0, radians(45.0));
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_DOUBLE_EQ(poses[0].theta_rad, 0.0);
  EXPECT_DOUBLE_EQ(poses[1].theta_rad, radians(90.0));
  EXPECT_DOUBLE_EQ(poses[2].theta_rad, radians(45.0));
  EXPECT_DOUBLE_EQ(poses_along({{0, 0}, {1, 0}}, 3.0, {}).back().theta_rad, 0.0);
  EXPECT_DOUBLE_EQ(poses_along({{0, 0}}, 3.0, {}).back().theta_rad, 3.0);
}

TEST(Routes, ClearanceIsTheDiscsEdgeToTheNearestWall) {
  const auto world = drawn_world(kTwoRooms);
  const DiscSpace space(world.grid, {});
  EXPECT_NEAR(clearance_along(space, {{0.25, 0.25}, {1.2, 0.25}}, 0.1), 0.05, 1e-3);
  EXPECT_EQ(clearance_along(space, {{0.15, 0.25}}, 0.1), 0.0);
}

}  // namespace
}  // namespace cairn
