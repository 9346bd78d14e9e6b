#include "planners/hybrid/length_lower_bound.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <random>

#include "planners/common/any_angle/disc_routes.hpp"
#include "planners/common/disc_space/routes.hpp"
#include "tests/planners/drawn_world.hpp"

namespace cairn {
namespace {

constexpr LogOdds kFree = -900;
constexpr LogOdds kOccupied = 900;

// Rooms with a door in most of their walls, clutter and patches that nobody has seen; not at the origin of the lattice.
class RandomRooms {
 public:
  // door_cells: of the narrowest.
  RandomRooms(std::uint64_t seed, int side_cells, int door_cells, double clutter_ratio)
      : random_(seed), side_(side_cells), corner_{any(-90, 20), any(-90, 20)}, grid_(0.05, 4.0, {-1.3, 0.7}) {
    const int room = door_cells + any(6, 30);
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x) set({x, y}, x % room == 0 || y % room == 0 ? kOccupied : kFree);
    for (int y = 0; y < side_; y += room)
      for (int x = 0; x < side_; x += room) open_doors({x, y}, room, door_cells);
    for (double left = clutter_ratio * side_ * side_; left > 0.0; left -= 1.0)
      set({any(0, side_ - 1), any(0, side_ - 1)}, kOccupied);
    for (int i = 0; i < 6; ++i) forget({any(0, side_ - 1), any(0, side_ - 1)}, any(1, 9));
  }

  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }
  [[nodiscard]] Point any_place() {
    std::uniform_real_distribution<double> along(0.0, side_ * grid_.cell_m());
    return grid_.origin_m() + grid_.cell_m() * Point(corner_.x, corner_.y) + Point(along(random_), along(random_));
  }

 private:
  int any(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }
  void set(Cell cell, LogOdds value) { grid_.set_log_odds(corner_ + cell, value); }
  void open_doors(Cell corner, int room, int door_cells) {
    for (const bool upright : {false, true}) {
      if (any(0, 9) == 0) continue;
      const int begin = any(1, room - door_cells);
      for (int i = begin; i < std::min(room, begin + any(door_cells, door_cells + 8)); ++i) {
        const Cell at = corner + (upright ? Cell{0, i} : Cell{i, 0});
        if (at.x < side_ && at.y < side_) set(at, kFree);
      }
    }
  }
  void forget(Cell corner, int across) {
    for (int y = corner.y; y < std::min(side_, corner.y + across); ++y)
      for (int x = corner.x; x < std::min(side_, corner.x + across); ++x) set({x, y}, 0);
  }

  std::mt19937_64 random_;
  int side_;
  Cell corner_;
  OccupancyGrid grid_;
};

struct Case {
  double radius_m;
  double clutter_ratio;
  UnknownPolicy unknown;
};

void PrintTo(const Case& of, std::ostream* out) {
  *out << of.radius_m << " m, clutter " << of.clutter_ratio
       << (of.unknown == UnknownPolicy::avoid ? ", unknown avoided" : ", unknown allowed");
}

class LengthLowerBounds : public ::testing::TestWithParam<Case> {
 protected:
  // Between places where the disc fits.
  void compare(RandomRooms& rooms, int pairs) {
    const auto space = std::make_shared<const DiscSpace>(rooms.grid(), rules_);
    const DiscRoutes routes(space, disc_m_);
    for (int tries = 0; tries < 20 * pairs && pairs > 0; ++tries) {
      const Point from = rooms.any_place();
      const Point to = rooms.any_place();
      if (!space->fits(from, disc_m_) || !space->fits(to, disc_m_)) continue;
      --pairs;
      compare(rooms.grid(), routes, from, to);
    }
  }

  const GroundRules rules_{GetParam().unknown, {}};
  const double disc_m_ = GetParam().radius_m + kMinRadius_m;
  int compared_ = 0;
  int impossible_ = 0;
  double bounds_m_ = 0.0;
  double lengths_m_ = 0.0;

 private:
  void compare(const OccupancyGrid& grid, const DiscRoutes& routes, const Point& from, const Point& to) {
    const double bound_m = length_lower_bound_m(grid, rules_, disc_m_, from, to, Budget{});
    const double min_m = routes.length_lower_bound_m(from, to, Budget{});
    EXPECT_LE(bound_m, min_m) << from.transpose() << " to " << to.transpose();
    if (std::isinf(min_m)) {
      ++impossible_;
      return;
    }
    EXPECT_GE(bound_m, (1.0 - 1e-5) * (to - from).norm());
    bounds_m_ += bound_m;
    lengths_m_ += min_m;
    if (++compared_ % 8 != 0) return;
    // The same of a route itself, which takes longer.
    const DiscRoute found = routes.route(from, to, Budget{});
    if (found.route.empty()) return;
    EXPECT_LE(bound_m, length_of(found.route)) << from.transpose() << " to " << to.transpose();
  }
};

TEST_P(LengthLowerBounds, AreNeverLongerThanTheWayThatMustBe) {
  const int door_cells = 5 + static_cast<int>(2.0 * GetParam().radius_m / 0.05);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomRooms rooms(seed, 150, door_cells, GetParam().clutter_ratio);
    compare(rooms, 40);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(compared_, 200) << impossible_ << " impossible";
  EXPECT_GT(bounds_m_, 0.8 * lengths_m_);
}

INSTANTIATE_TEST_SUITE_P(Cases, LengthLowerBounds,
                         ::testing::Values(Case{0.22, 0.0, UnknownPolicy::avoid},
                                           Case{0.22, 0.003, UnknownPolicy::allow},
                                           Case{0.14, 0.004, UnknownPolicy::avoid},
                                           Case{0.1, 0.02, UnknownPolicy::allow},
                                           Case{0.0, 0.2, UnknownPolicy::avoid}));

TEST(LengthLowerBound, GoesRoundAWall) {
  const test::DrawnWorld world = test::drawn_world(
      "###################\n"
      "#.................#\n"
      "#.......#.........#\n"
      "#.A.....#.......B.#\n"
      "#.......#.........#\n"
      "###################\n",
      0.05, 12);
  const Point a = world.places.at('A');
  const Point b = world.places.at('B');
  const double straight_m = (b - a).norm();
  const auto space = std::make_shared<const DiscSpace>(world.grid, GroundRules{});
  const double min_m = DiscRoutes(space, 0.22).length_lower_bound_m(a, b, {});
  const double bound_m = length_lower_bound_m(world.grid, {}, 0.22, a, b, {});
  EXPECT_GT(bound_m, straight_m + 0.5 * (min_m - straight_m));
  EXPECT_LE(bound_m, min_m);
}

TEST(LengthLowerBound, IsEndlessWhereNoneLeadsAndNotKnownWithoutTime) {
  const test::DrawnWorld world = test::drawn_world("A..?..B\n", 0.05, 12);
  const Point a = world.places.at('A');
  const Point b = world.places.at('B');
  EXPECT_TRUE(std::isinf(length_lower_bound_m(world.grid, {UnknownPolicy::avoid, {}}, 0.22, a, b, {})));
  EXPECT_NEAR(length_lower_bound_m(world.grid, {UnknownPolicy::allow, {}}, 0.22, a, b, {}), (b - a).norm(), 1e-4);
  const std::atomic<bool> cancel = true;
  Budget none;
  none.cancel = &cancel;
  EXPECT_EQ(length_lower_bound_m(world.grid, {UnknownPolicy::allow, {}}, 0.22, a, b, none), 0.0);
}

}  // namespace
}  // namespace cairn
