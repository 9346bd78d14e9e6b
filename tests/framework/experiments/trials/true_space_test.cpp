#include "framework/experiments/trials/true_space.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Two rooms of 2 x 2 m, a door of 1 m between them, a pole in the left one:
//   +----+----+
//   |    |    |
//   | o       |
//   |    |    |
//   +----+----+
World two_rooms() {
  World world;
  world.max_m = {4.0, 2.0};
  world.walls = {{{{0, 0}, {4, 0}, {4, 2}, {0, 2}, {0, 0}}}, {{{2, 0}, {2, 0.5}}}, {{{2, 1.5}, {2, 2}}}};
  WorldObject pole;
  pole.category = "pole";
  pole.contour = Contour::circle(0.2);
  pole.T_map_object = {0.5, 1.0, 0.0};
  world.objects = {pole};
  WorldDoor door;
  door.from_m = {2.0, 0.5};
  door.to_m = {2.0, 1.5};
  door.closed_s = {{10.0, 20.0}};
  world.doors = {door};
  return world;
}

TEST(TrueSpace, ADiscHasRoomWhereNothingIsNearerThanItsRadius) {
  const TrueSpace space(two_rooms(), 0.3);
  EXPECT_TRUE(space.has_room({1.2, 1.0}));
  EXPECT_FALSE(space.has_room({0.29, 1.7})) << "the west wall";
  EXPECT_TRUE(space.has_room({0.31, 1.69}));
  EXPECT_FALSE(space.has_room({0.89, 1.0})) << "the pole";
  EXPECT_TRUE(space.has_room({0.91, 1.0}));
  EXPECT_FALSE(space.has_room({0.5, 1.0})) << "inside of the pole";
  EXPECT_FALSE(space.has_room({-1.0, 1.0})) << "outside of the world";
  EXPECT_TRUE(space.has_room({2.0, 1.0})) << "in the open door";
}

TEST(TrueSpace, RoomsAreJoinedWhileTheDoorIsOpenAndWideEnough) {
  TrueSpace space(two_rooms(), 0.3);
  const TrueSpace::Cells west = space.cells_near({1.2, 1.0}, 0.1);
  const TrueSpace::Cells east = space.cells_near({3.0, 1.0}, 0.1);
  ASSERT_FALSE(west.empty());
  EXPECT_TRUE(space.joined(west, east, space.doors_at(9.0)));
  EXPECT_FALSE(space.joined(west, east, space.doors_at(10.0)));
  EXPECT_TRUE(space.joined(west, east, space.doors_at(20.0)));
  EXPECT_TRUE(space.joined(west, space.cells_near({1.5, 0.5}, 0.1), space.doors_at(10.0)));
  TrueSpace wide(two_rooms(), 0.55);
  EXPECT_FALSE(wide.joined(wide.cells_near({1.3, 1.0}, 0.2), wide.cells_near({3.0, 1.0}, 0.2), {false}))
      << "a disc of 1.1 m and a door of 1 m";
}

TEST(TrueSpace, CellsBesideAThingTouchItWithinTheGivenDistance) {
  const World world = two_rooms();
  const TrueSpace space(world, 0.3);
  const TrueSpace::Cells beside = space.cells_beside(world.objects.front(), 0.4);
  EXPECT_FALSE(beside.empty());
  EXPECT_TRUE(space.cells_beside(world.objects.front(), 0.25).empty()) << "nearer than the disc's radius";
  TrueSpace same = space;
  EXPECT_FALSE(same.joined(beside, same.cells_near({3.0, 1.0}, 0.1), {true}));
  EXPECT_TRUE(same.joined(beside, same.cells_near({1.2, 1.0}, 0.1), {true}));
}

}  // namespace
}  // namespace cairn
