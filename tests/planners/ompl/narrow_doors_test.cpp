// Doors whose free strip is narrower than the nodes of the fastest path's lattice lie apart.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "tests/planners/ompl/ompl_worlds.hpp"

namespace cairn {
namespace {

constexpr double kDoorRobot_m = 0.22;

// Two rooms of 3 x 3 m, a wall of 0.1 m between them and a door in it; a box in each, past which the shortest path
// goes.
struct DoorCase {
  double cell_m;
  int wall_cells;
  int lower_cell;  // of the door's
  int door_cells;

  [[nodiscard]] double room_m() const { return 0.5 * door_cells * cell_m - kDoorRobot_m; }  // to both sides
  [[nodiscard]] double middle_m() const { return (lower_cell + 0.5 * door_cells) * cell_m; }
  [[nodiscard]] double wall_m() const { return 3.0 + 0.5 * wall_cells * cell_m; }
};

test::DrawnWorld rooms_with_door(const DoorCase& door) {
  const auto cells = [&](double metres) { return static_cast<int>(std::lround(metres / door.cell_m)); };
  test::DrawnWorld world;
  world.grid = OccupancyGrid(door.cell_m);
  const int first = cells(3.0);
  const int width = 2 * first + door.wall_cells;
  for (int y = 0; y < first; ++y)
    for (int x = 0; x < width; ++x) {
      const bool in_wall = x >= first && x < first + door.wall_cells;
      const bool in_door = y >= door.lower_cell && y < door.lower_cell + door.door_cells;
      const Point p = (Point(x, y) + Point(0.5, 0.5)) * door.cell_m;
      const bool in_box = p.y() > 0.6 && p.y() < 1.9 && ((p.x() > 1.0 && p.x() < 2.0) || (p.x() > 4.1 && p.x() < 4.7));
      world.grid.set_log_odds({x, y}, in_box || (in_wall && !in_door) ? LogOdds{900} : LogOdds{-900});
    }
  world.places['A'] = {0.8, 2.4};
  world.places['B'] = {5.3, 2.2};
  world.robot.radius_m = kDoorRobot_m;
  return world;
}

PathResult fastest_through(const test::DrawnWorld& world, double margin_m) {
  WorldView view = world.view();
  view.speed_law = SpeedLaw{};
  OmplConfig config;
  config.margin_m = margin_m;
  return OmplPlanner(config).plan(world.request('A', 'B', kDoorRobot_m), view, {});
}

double crossing_at(const std::vector<Pose2>& path, double x_m) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point a = path[i - 1].position();
    const Point b = path[i].position();
    if (a.x() <= x_m && x_m < b.x()) return a.y() + (b.y() - a.y()) * (x_m - a.x()) / (b.x() - a.x());
  }
  return -1.0;
}

// 0.9 m, and what a map may leave of it, at the margins that are tried one after the other and at one that just fits.
template <class Check>
void for_doors(std::initializer_list<double> doors_m, const Check& check) {
  for (const double cell_m : {0.05, 0.025})
    for (const double door_m : doors_m)
      for (int shift = 0; shift < 2; ++shift) {
        const auto cells = [&](double metres) { return static_cast<int>(std::lround(metres / cell_m)); };
        const DoorCase door{cell_m, cells(0.1), cells(0.8) + shift, cells(door_m)};
        for (const double margin_m : {0.0, 0.06, 0.12, door.room_m() - 0.01}) {
          if (margin_m > door.room_m() - 0.005) continue;
          SCOPED_TRACE(testing::Message() << door_m << " m from " << door.lower_cell << " cells of " << cell_m
                                          << " m, margin " << margin_m);
          const PathResult through = fastest_through(rooms_with_door(door), margin_m);
          ASSERT_EQ(through.outcome, PlanOutcome::solved) << through.reason;
          check(door, margin_m, through);
        }
      }
}

TEST(NarrowDoors, AreTakenInTheMiddleWhereverTheyLieAmongTheNodes) {
  for_doors({0.65, 0.75, 0.9}, [](const DoorCase& door, double, const PathResult& through) {
    EXPECT_NEAR(crossing_at(through.path, door.wall_m()), door.middle_m(), 0.04);
    EXPECT_GT(through.clearance_m, std::min(0.14, door.room_m() - 0.04));
  });
}

TEST(NarrowDoors, TakeHardlyLongerThanSlightlyWiderOnes) {
  for_doors({0.75, 0.9}, [](DoorCase door, double margin_m, const PathResult& through) {
    ++door.door_cells;
    const PathResult wider = fastest_through(rooms_with_door(door), margin_m);
    ASSERT_EQ(wider.outcome, PlanOutcome::solved) << wider.reason;
    EXPECT_LE(*through.driving_time_s, 1.1 * *wider.driving_time_s);
  });
}

TEST(NarrowDoors, AMarginThatJustFitsDoesNotSlowTheRestOfTheRoute) {
  for_doors({0.65, 0.75, 0.9}, [](const DoorCase& door, double, const PathResult& through) {
    EXPECT_LE(*through.driving_time_s, 1.05 * *fastest_through(rooms_with_door(door), 0.0).driving_time_s);
  });
}

// The niche is left at a creep, since nothing else leads out of it; the rest of the route is not slower for that.
TEST(NarrowDoors, AnEndThatNoNodeJoinsLeavesTheRestOfTheRouteFast) {
  const DoorCase door{0.05, 2, 16, 18};
  const double open_s = *fastest_through(rooms_with_door(door), 0.0).driving_time_s;
  for (const int lower : {43, 44}) {
    auto world = rooms_with_door(door);
    // A niche around A, 0.45 m wide and open to the right.
    for (int y = lower - 5; y < 60; ++y)
      for (int x = 0; x < 22; ++x)
        if (y < lower || y >= lower + 9) world.grid.set_log_odds({x, y}, LogOdds{900});
    world.places['A'] = {0.8, (lower + 4.5) * door.cell_m};
    const PathResult out = fastest_through(world, 0.0);
    ASSERT_EQ(out.outcome, PlanOutcome::solved) << out.reason;
    EXPECT_NEAR(crossing_at(out.path, door.wall_m()), door.middle_m(), 0.04);
    EXPECT_LT(*out.driving_time_s, open_s + 0.4 / SpeedLaw{}.creep_mps);
  }
}

}  // namespace
}  // namespace cairn
