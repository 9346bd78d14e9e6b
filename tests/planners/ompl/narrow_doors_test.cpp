// Doors whose free strip is narrower than the nodes of the fastest path's lattice lie apart.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/planners/ompl/ompl_worlds.hpp"

namespace cairn {
namespace {

constexpr double kDoorRobot_m = 0.22;

// Two rooms of 3 x 3 m, a wall of 0.1 m between them and a door in it.
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
      world.grid.set_log_odds({x, y}, in_wall && !in_door ? LogOdds{900} : LogOdds{-900});
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

void check_door(const DoorCase& door, double margin_m) {
  SCOPED_TRACE(testing::Message() << door.door_cells << " cells of " << door.cell_m << " m from " << door.lower_cell
                                  << ", margin " << margin_m);
  const auto world = rooms_with_door(door);
  const PathResult through = fastest_through(world, margin_m);
  ASSERT_EQ(through.outcome, PlanOutcome::solved) << through.reason;
  EXPECT_NEAR(crossing_at(through.path, door.wall_m()), door.middle_m(), 0.04);
  EXPECT_GT(through.clearance_m, std::min(0.14, door.room_m() - 0.04));
  DoorCase wider = door;
  ++wider.door_cells;
  const PathResult through_wider = fastest_through(rooms_with_door(wider), margin_m);
  ASSERT_EQ(through_wider.outcome, PlanOutcome::solved) << through_wider.reason;
  EXPECT_LE(*through.driving_time_s, 1.1 * *through_wider.driving_time_s);
}

// 0.9 m, and what a map may leave of it, at the margins that are tried one after the other and at one that just fits.
TEST(NarrowDoors, AreTakenInTheMiddleWhereverTheyLieAmongTheNodes) {
  for (const double cell_m : {0.05, 0.025})
    for (const double door_m : {0.75, 0.8, 0.9})
      for (int shift = 0; shift < 2; ++shift) {
        const int cells = static_cast<int>(std::lround(door_m / cell_m));
        const DoorCase door{cell_m, static_cast<int>(std::lround(0.1 / cell_m)),
                            static_cast<int>(std::lround(0.8 / cell_m)) + shift, cells};
        for (const double margin_m : {0.0, 0.06, 0.12}) check_door(door, margin_m);
        check_door(door, door.room_m() - 0.01);
      }
}

// The niche is left at a creep, since nothing else leads out of it; the rest of the route is not slower for that.
TEST(NarrowDoors, AnEndThatNoNodeJoinsLeavesTheRestOfTheRouteFast) {
  const DoorCase door{0.05, 2, 16, 18};
  auto world = rooms_with_door(door);
  const double open_s = *fastest_through(world, 0.0).driving_time_s;
  // A niche around A, 0.45 m wide and open below.
  for (int y = 44; y < 60; ++y)
    for (int x = 0; x < 40; ++x)
      if (x < 11 || x >= 20 || y >= 54) world.grid.set_log_odds({x, y}, LogOdds{900});
  world.places['A'] = {0.775, 2.4};
  const PathResult out = fastest_through(world, 0.0);
  ASSERT_EQ(out.outcome, PlanOutcome::solved) << out.reason;
  EXPECT_NEAR(crossing_at(out.path, door.wall_m()), door.middle_m(), 0.04);
  EXPECT_LT(*out.driving_time_s, open_s + 0.6 / SpeedLaw{}.creep_mps);
}

}  // namespace
}  // namespace cairn
