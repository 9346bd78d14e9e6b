// The known share in generated homes whose rooms become known one after the other, without driving.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "framework/experiments/homes/home.hpp"
#include "framework/experiments/trials/true_space.hpp"
#include "framework/files/world_file.hpp"
#include "plugins/behaviours/exploring/known_share.hpp"
#include "plugins/behaviours/lookouts/passages.hpp"
#include "tests/framework/config/config_test_support.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kRadius_m = 0.22;
constexpr double kClearance_m = 0.05;

struct HomeOfRooms {
  explicit HomeOfRooms(std::uint64_t seed) : home(random_home({.max_area_m2 = 70.0}, seed)) {
    const config_test::TestFolder folder;
    const World world = load_world(folder.write("world.yaml", home.world_yaml), {});
    free_m = TrueSpace(world, 0.03).reached_from(home.start_m);
    places_m = TrueSpace(world, kRadius_m).reached_from(home.start_m);
    roomy_m = TrueSpace(world, kRadius_m + 2.0 * kClearance_m).reached_from(home.start_m);
    for (const Point& p : free_m) free.insert(grid.cell_at(p));
  }
  [[nodiscard]] int room_of(const Point& p) const {
    for (std::size_t i = 0; i < home.rooms.size(); ++i)
      if (home.rooms[i].contains(p)) return static_cast<int>(i);
    return -1;
  }
  // A room that is joined to one of these by a door.
  [[nodiscard]] int room_beside(const std::set<int>& entered) const {
    for (const HomeDoor& door : home.doors)
      for (const int side : {0, 1})
        if (entered.contains(door.rooms[side]) && !entered.contains(door.rooms[1 - side])) return door.rooms[1 - side];
    return -1;
  }
  // Its free cells and those of its doors, and the walls round them.
  void reveal(int room) {
    const auto is_of_room = [&](const Point& p) {
      return room_of(p) == room || std::ranges::any_of(home.doors, [&](const HomeDoor& door) {
               const bool is_its = door.rooms[0] == room || door.rooms[1] == room;
               return is_its && room_of(p) < 0 && (p - door.middle_m).norm() < door.width_m;
             });
    };
    for (const Point& p : free_m) {
      if (!is_of_room(p)) continue;
      const Cell c = grid.cell_at(p);
      grid.set_log_odds(c, -600);
      for (const Cell step : kNeighbours)
        if (!free.contains(c + step)) grid.set_log_odds(c + step, 600);
    }
    const auto inside = std::ranges::find_if(roomy_m, [&](const Point& p) { return room_of(p) == room; });
    if (inside != roomy_m.end()) trace.push_back({inside->x(), inside->y(), 0.0});
  }
  [[nodiscard]] double true_share(const std::set<int>& entered) const {
    const auto known = std::ranges::count_if(places_m, [&](const Point& p) { return entered.contains(room_of(p)); });
    return static_cast<double>(known) / static_cast<double>(places_m.size());
  }

  Home home;
  OccupancyGrid grid{0.05};
  std::vector<Point> free_m;
  std::vector<Point> places_m;  // for the robot's centre
  std::vector<Point> roomy_m;   // with more room
  std::set<Cell> free;
  std::vector<Pose2> trace;
};

TEST(KnownShareOfHomes, IsNeverWholeBeforeAllRoomsAreKnownAndNeverFalls) {
  for (const std::uint64_t seed : {501, 502, 503, 504}) {
    HomeOfRooms map(seed);
    KnownShare share;
    std::set<int> entered;
    double last = 0.0;
    for (int room = map.room_of(map.home.start_m); room >= 0; room = map.room_beside(entered)) {
      entered.insert(room);
      map.reveal(room);
      const FreeSpace space(map.grid, {map.trace.back().position(), kRadius_m, kClearance_m}, map.trace);
      share.count(space, reach_of(space, map.trace), 0, 0.1, 0.0);
      share.settle();
      EXPECT_GE(share.ratio(), last) << seed;
      last = share.ratio();
      const double truth = map.true_share(entered);
      if (entered.size() < map.home.rooms.size()) {
        EXPECT_LT(share.ratio(), 0.97) << seed << ", truly " << truth;
        EXPECT_NEAR(share.ratio(), truth, 0.4) << seed;
      }
    }
    EXPECT_EQ(entered.size(), map.home.rooms.size()) << seed;
    EXPECT_GT(share.ratio(), 0.99) << seed;
  }
}

}  // namespace
}  // namespace cairn::behaviours
