#include "maps/hierarchy/route_costs.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/maps/drawn_grid.hpp"

namespace cairn {
namespace {

Route along(std::vector<Pose2> trajectory, double cost_m) {
  Route route;
  route.trajectory = std::move(trajectory);
  route.cost_m = cost_m;
  return route;
}

TEST(RouteCosts, HaveNamesAndUnits) {
  EXPECT_EQ(name_of(CostKind::length), "length");
  EXPECT_EQ(name_of(CostKind::time), "time");
  EXPECT_EQ(name_of(CostKind::clearance), "clearance");
  EXPECT_EQ(unit_of(CostKind::length), "m");
  EXPECT_EQ(unit_of(CostKind::time), "s");
  EXPECT_EQ(unit_of(CostKind::clearance), "m");
}

TEST(RouteCosts, ByLengthIsWhatTheRouteSays) {
  EXPECT_EQ(route_cost(CostKind::length, {})(along({{0, 0, 0}, {1, 0, 0}}, 7.5)), 7.5);
}

TEST(RouteCosts, ByTimeIsDrivingAndTurning) {
  RouteCostRules rules;
  rules.speed_mps = 0.5;
  rules.turn_radps = 2.0;
  const RouteCost time = route_cost(CostKind::time, rules);
  const double right = std::numbers::pi / 2;
  EXPECT_DOUBLE_EQ(time(along({{0, 0, 0}, {3, 4, 0}}, 99.0)), 10.0);
  EXPECT_DOUBLE_EQ(time(along({{0, 0, 0}, {2, 0, 0}, {2, 0, right}, {2, 1, right}}, 3.0)), 6.0 + right / 2.0);
  EXPECT_DOUBLE_EQ(time(along({{0, 0, 3.0}, {0, 0, -3.0}}, 0.0)), (2 * std::numbers::pi - 6.0) / 2.0)
      << "the short route round";
  EXPECT_DOUBLE_EQ(time(along({}, 4.0)), 8.0) << "without a trajectory";
}

TEST(RouteCosts, ByTimeKeepsToTheLimitOfTheRouteAndToTheRobots) {
  RouteCostRules rules;
  rules.speed_mps = 0.5;
  Route route = along({}, 4.0);
  route.speed_limit_mps = 0.25;
  EXPECT_DOUBLE_EQ(route_cost(CostKind::time, rules)(route), 16.0);
  route.speed_limit_mps = 5.0;
  EXPECT_DOUBLE_EQ(route_cost(CostKind::time, rules)(route), 8.0);
}

TEST(RouteCosts, ByClearanceCountsNarrowMetresUpToFiveTimes) {
  // A wall below; free ground above it, 4 m wide and 4 m high.
  std::vector<std::string> rows(39, std::string(40, '.'));
  rows.push_back(std::string(40, '#'));
  const OccupancyGrid grid = drawn(rows);
  RouteCostRules rules;
  rules.radius_m = 0.2;
  rules.grid = &grid;
  const RouteCost clearance = route_cost(CostKind::clearance, rules);
  const auto straight_at = [&](double y_m) { return clearance(along({{1, y_m, 0}, {3, y_m, 0}}, 2.0)); };
  EXPECT_DOUBLE_EQ(straight_at(2.05), 2.0) << "more than half a metre of room";
  EXPECT_DOUBLE_EQ(straight_at(0.05), 10.0) << "none";
  const double middle = straight_at(0.55);
  EXPECT_GT(middle, 2.0);
  EXPECT_LT(middle, 10.0);
  EXPECT_GT(straight_at(0.35), middle);
  EXPECT_EQ(clearance(along({}, 3.0)), 3.0) << "without a trajectory";
  EXPECT_EQ(route_cost(CostKind::clearance, {})(along({{0, 0, 0}, {1, 0, 0}}, 3.0)), 3.0) << "without a map";
}

}  // namespace
}  // namespace cairn
