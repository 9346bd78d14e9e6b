#include "framework/program/view/map_view.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(MapView, CoarseLevelsKeepWallsAndLeaveUnknownCellsUnknown) {
  OccupancyGrid grid(0.05);
  grid.include({{-1, 0}, {4, 2}});
  grid.set_log_odds({-1, 0}, -500);
  grid.set_log_odds({0, 1}, 500);
  const std::string fine = view_cells(grid, 1);
  ASSERT_EQ(fine.size(), 10U);
  const std::string coarse = view_cells(grid, 2);
  ASSERT_EQ(coarse.size(), 3U);
  EXPECT_EQ(static_cast<std::uint8_t>(coarse[0]), ol_of(500));
  EXPECT_EQ(static_cast<std::uint8_t>(coarse[1]), kUnknownOl);
  EXPECT_EQ(static_cast<std::uint8_t>(fine[0]), ol_of(-500));
}

TEST(MapView, AnEmptyGridHasNoLevels) {
  EXPECT_TRUE(view_levels(OccupancyGrid(0.05)).empty());
}

TEST(MapView, LargeGridsBeginAtACoarserLevel) {
  OccupancyGrid grid(0.05);
  grid.include({{0, 0}, {8000, 4000}});
  EXPECT_EQ(view_levels(grid), (std::vector<int>{2, 4, 8, 16}));
}

TEST(MapView, RoutesWithoutATrajectoryAreStraight) {
  LandmarkGraph graph;
  Landmark a, b;
  a.T_map_landmark = {1.0, 2.0, 0.0};
  b.T_map_landmark = {4.0, 6.0, 0.0};
  Route route;
  route.from = graph.add(a);
  route.to = graph.add(b);
  route.cost_m = 5.0;
  graph.add_route(route);
  EXPECT_NE(view_routes_json(graph).find("\"points\":[[1.0,2.0],[4.0,6.0]]"), std::string::npos)
      << view_routes_json(graph);
}

}  // namespace
}  // namespace cairn
