#include "planners/hybrid/windows/windows.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/planners/hybrid/rooms_world.hpp"

namespace cairn {
namespace {

using test::RoomsWorld;

constexpr double kDisc_m = 0.2;

TEST(WindowCache, KeepsAWindowUntilItsCellsChange) {
  RoomsWorld world(6);
  const WindowCache cache;
  const CellBox box{{0, 0}, {80, 80}};
  const auto first = cache.window_of(world.view(), box, {}, kDisc_m);
  EXPECT_EQ(cache.window_of(world.view(), box, {}, kDisc_m), first);
  world.grid.set_log_odds({100, 100}, 900);
  EXPECT_EQ(cache.window_of(world.view(), box, {}, kDisc_m), first) << "outside of it";
  world.grid.set_log_odds({20, 20}, 900);
  const auto second = cache.window_of(world.view(), box, {}, kDisc_m);
  EXPECT_NE(second, first);
  EXPECT_TRUE(second->routes->space().is_blocked({20, 20}));
  EXPECT_NE(cache.window_of(world.view(), box, {}, 0.3), second) << "for another disc";
  GroundRules allowing;
  allowing.unknown = UnknownPolicy::allow;
  EXPECT_NE(cache.window_of(world.view(), box, allowing, kDisc_m), second);
}

TEST(WindowCache, TakesTheVersionsWordForIt) {
  RoomsWorld world(6);
  const WindowCache cache;
  const CellBox box{{0, 0}, {80, 80}};
  WorldView view = world.view();
  view.grid_version = 3;
  const auto first = cache.window_of(view, box, {}, kDisc_m);
  world.grid.set_log_odds({20, 20}, 900);
  EXPECT_EQ(cache.window_of(view, box, {}, kDisc_m), first);
  view.grid_version = 4;
  EXPECT_NE(cache.window_of(view, box, {}, kDisc_m), first);
}

class WindowedGrounds : public testing::Test {
 protected:
  RoomsWorld world_{6};
  WorldView view_ = world_.view();
  OmplPlanner path_planner_{OmplConfig{}};
  WindowCache cache_;
  WindowedGround ground_{view_, {}, kDisc_m, path_planner_, cache_, {3.0, 1, 4, 6.0}, true};
};

TEST_F(WindowedGrounds, LinesFitWhereTheyDoOnTheWholeGrid) {
  const DiscSpace space(world_.grid, {});
  std::mt19937_64 random(3);
  int fits = 0;
  for (int i = 0; i < 400; ++i) {
    const Point from = world_.any_place(random, 0.1);
    const Point to = from + 0.2 * (world_.any_place(random, 0.1) - from);
    EXPECT_EQ(ground_.fits_along(from, to), space.fits_along(from, to, kDisc_m));
    fits += ground_.fits_along(from, to) ? 1 : 0;
  }
  EXPECT_GT(fits, 50);
  EXPECT_LT(fits, 350);
  EXPECT_FALSE(ground_.fits_along({-1.0, 2.0}, {-1.0, 2.0}));
  EXPECT_FALSE(ground_.fits_along({1.0, 2.0}, {std::numeric_limits<double>::quiet_NaN(), 2.0}));
}

TEST_F(WindowedGrounds, NoPathThatLeavesTheWindowIsShorterThanItsBound) {
  const Point from(10.0, 10.0);
  const Point to(13.0, 10.0);
  const CellBox box = ground_.box_round(from, to, 1);
  EXPECT_EQ(box, (CellBox{{60, 60}, {180, 150}}));
  // By way of the upper rim at y = 15, and of the lower one at y = 6.
  EXPECT_NEAR(ground_.min_outside_m(from, to, box), std::hypot(3.0, 2.0 * (4.0 - kDisc_m)), 1e-9);
  EXPECT_EQ(ground_.min_outside_m(from, to, world_.grid.bounds()), std::numeric_limits<double>::infinity());
  const Point outside(-5.0, 99.0);
  EXPECT_FALSE(ground_.box_round(outside, outside, 1).empty()) << "the blocks of the nearest cells";
}

TEST_F(WindowedGrounds, ClearancesReachAsFarAsTheyMust) {
  OccupancyGrid hall(0.1);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) hall.set_log_odds({x, y}, -900);
  hall.set_log_odds({100, 100}, 900);
  const WorldView view{hall, world_.graph, world_.robot, {}, 0.0};
  const WindowedGround ground(view, {}, kDisc_m, path_planner_, cache_, {3.0, 1, 4, 6.0}, true);
  const std::vector<Point> route{{5.0, 7.0}, {15.0, 7.0}};
  EXPECT_NEAR(ground.clearance_m(route, kDisc_m), 3.0 - kDisc_m, 1e-9);
}

}  // namespace
}  // namespace cairn
