#include "framework/planning/saved_map/map_part.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cairn {
namespace {

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution(low, high)(random);
}

// 200 x 100 cells of 0.1 m from (-3, 2).
OccupancyGrid any_grid() {
  OccupancyGrid grid(0.1, 4.0, {-3.0, 2.0});
  grid.include({{-20, 10}, {180, 110}});
  return grid;
}

MapEnds any_ends(std::mt19937_64& random) {
  const auto point = [&] { return Point(uniform(random, -5.0, 15.0), uniform(random, 3.0, 13.0)); };
  const Point from = point();
  return {from, point()};
}

TEST(MapPart, HoldsEveryPointOfAWayOfThatLength) {
  const OccupancyGrid grid = any_grid();
  std::mt19937_64 random(4);
  int inside = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const MapEnds ends = any_ends(random);
    const double length_m = (ends.to - ends.from).norm() + uniform(random, 0.0, 3.0);
    const CellBox part = part_for(ends, length_m, 0.25, grid, grid.bounds());
    const Point by(uniform(random, -5.0, 15.0), uniform(random, 3.0, 13.0));
    if ((by - ends.from).norm() + (ends.to - by).norm() > length_m) continue;
    ++inside;
    for (const Point& off : {Point(0.25, 0.0), Point(-0.25, 0.0), Point(0.0, 0.25), Point(0.0, -0.25)}) {
      const Cell cell = grid.cell_at(by + off);
      EXPECT_TRUE(part.contains(cell) || !grid.bounds().contains(cell));
    }
  }
  EXPECT_GT(inside, 300);
}

TEST(MapPart, NoWayByItsRimIsShorterThanSaid) {
  const OccupancyGrid grid = any_grid();
  std::mt19937_64 random(5);
  int bounded = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const MapEnds ends = any_ends(random);
    const CellBox part = part_for(ends, (ends.to - ends.from).norm() + 2.0, 0.5, grid, grid.bounds());
    const double min_m = min_outside_m(ends, part, 0.2, grid, grid.bounds());
    if (!std::isfinite(min_m)) continue;
    double found_m = std::numeric_limits<double>::infinity();
    const Point low = grid.origin_m() + 0.1 * Point(part.min.x, part.min.y);
    const Point high = grid.origin_m() + 0.1 * Point(part.max.x, part.max.y);
    const auto by = [&](const Point& p) { found_m = std::min(found_m, (p - ends.from).norm() + (ends.to - p).norm()); };
    for (double share = 0.0; share <= 1.0; share += 1e-3) {
      const Point at = low + share * (high - low);
      if (part.min.x > grid.bounds().min.x) by({low.x() + 0.2, at.y()});
      if (part.max.x < grid.bounds().max.x) by({high.x() - 0.2, at.y()});
      if (part.min.y > grid.bounds().min.y) by({at.x(), low.y() + 0.2});
      if (part.max.y < grid.bounds().max.y) by({at.x(), high.y() - 0.2});
    }
    EXPECT_LE(min_m, found_m + 1e-9);
    EXPECT_GT(min_m, found_m - 0.1) << "it is no guess";
    ++bounded;
  }
  EXPECT_GT(bounded, 300);
}

TEST(MapPart, AnEndAtTheRimBoundsNothing) {
  const OccupancyGrid grid = any_grid();
  const MapEnds ends{{0.0, 8.0}, {4.0, 8.0}};
  const CellBox part{{30, 20}, {60, 100}};  // x from 0 to 3 m
  EXPECT_EQ(min_outside_m(ends, part, 0.2, grid, grid.bounds()), 0.0);
  EXPECT_EQ(min_outside_m(ends, grid.bounds(), 0.2, grid, grid.bounds()), std::numeric_limits<double>::infinity());
}

TEST(MapPart, EndsAreThoseOfRequestsThatLeaveNoChoice) {
  LandmarkGraph graph;
  Landmark landmark;
  landmark.T_map_landmark = {4.0, 5.0, 0.0};
  const LandmarkId bare = graph.add(landmark);
  landmark.access = Pose2{6.0, 7.0, 0.0};
  const LandmarkId stood_at = graph.add(landmark);
  PlanRequest request;
  request.from.landmarks = {bare};
  request.to.landmarks = {stood_at};
  ASSERT_TRUE(ends_of(request, graph));
  EXPECT_EQ(ends_of(request, graph)->from, Point(4.0, 5.0));
  EXPECT_EQ(ends_of(request, graph)->to, Point(6.0, 7.0));
  request.to.landmarks = {bare, stood_at};
  EXPECT_FALSE(ends_of(request, graph));
  request.to.landmarks = {77};
  EXPECT_FALSE(ends_of(request, graph));
  request.to.pose = Pose2{NAN, 0.0, 0.0};
  EXPECT_FALSE(ends_of(request, graph));
}

TEST(MapPart, ACostBelowTheStraightWayIsNoLength) {
  LandmarkGraph graph;
  Landmark landmark;
  const LandmarkId a = graph.add(landmark);
  landmark.T_map_landmark = {3.0, 4.0, 0.0};
  const LandmarkId b = graph.add(landmark);
  Route route;
  route.from = a;
  route.to = b;
  route.cost_m = 5.0;
  graph.add_route(route);
  EXPECT_TRUE(costs_are_lengths(graph));
  route.cost_m = 4.9;
  graph.add_route(route);
  EXPECT_FALSE(costs_are_lengths(graph));
}

}  // namespace
}  // namespace cairn
