#include "maps/relocalisation/surroundings.hpp"

#include <gtest/gtest.h>

#include "tests/maps/drawn_grid.hpp"

namespace cairn {
namespace {

TEST(Surroundings, OccupiedAndFreeSquaresAreSeenFromTheRobot) {
  const OccupancyGrid seen = drawn({"#.....", "#.....", "#....."});
  const Surroundings around =
      surroundings_of(seen, {0.55, 0.15, radians(90.0)}, {.raster_m = 0.1, .free_raster_m = 0.1});
  ASSERT_EQ(around.echoes_m.size(), 3U);
  EXPECT_NEAR(around.echoes_m[1].x(), 0.0, 1e-9);
  EXPECT_NEAR(around.echoes_m[1].y(), 0.5, 1e-9) << "the wall is to the left of a robot that looks up";
  EXPECT_EQ(around.free_m.size(), 9U) << "not the two columns beside the wall";
}

TEST(Surroundings, TakesNoMorePointsThanItMay) {
  const OccupancyGrid seen = drawn({"##########", "..........", "..........", ".........."});
  const Surroundings around =
      surroundings_of(seen, {}, {.raster_m = 0.1, .free_raster_m = 0.1, .echoes_at_most = 4, .free_at_most = 3});
  EXPECT_EQ(around.echoes_m.size(), 4U);
  EXPECT_EQ(around.free_m.size(), 3U);
}

TEST(Surroundings, AnEmptyMapHasNone) {
  const Surroundings around = surroundings_of(OccupancyGrid(0.05), {});
  EXPECT_TRUE(around.echoes_m.empty());
  EXPECT_TRUE(around.free_m.empty());
}

TEST(Surroundings, ASquareOfTheRasterIsOccupiedWhenOneOfItsCellsIs) {
  const RasterPoints points = raster_points(drawn({"..#?", "...?"}, 0.05), 0.1);
  ASSERT_EQ(points.occupied_m.size(), 1U);
  EXPECT_NEAR(points.occupied_m.front().x(), 0.15, 1e-9);
  ASSERT_EQ(points.free_m.size(), 1U);
  EXPECT_NEAR(points.free_m.front().x(), 0.05, 1e-9);
}

}  // namespace
}  // namespace cairn
