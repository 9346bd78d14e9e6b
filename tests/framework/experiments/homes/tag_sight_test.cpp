#include "framework/experiments/homes/tag_sight.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

World room_of_8_m() {
  World world;
  world.max_m = {8.0, 8.0};
  world.walls = {{{{0.0, 0.0}, {8.0, 0.0}, {8.0, 8.0}, {0.0, 8.0}, {0.0, 0.0}}, Surface::rough}};
  return world;
}

// A room of 8 x 8 m with a tag in the middle of its right wall.
struct Room : testing::Test {
  Room() : world(room_of_8_m()) { world.tags = {{{MarkerFamily::tag36h11, 7}, {8.0, 4.0, radians(180.0)}, 0.3, 0.16}}; }

  [[nodiscard]] std::optional<TagSighted> seen_from(double x_m, double y_m, double heading_deg,
                                                    const SightLimits& limits = {}) const {
    return TagSight(world).of(world.tags[0], CameraModel{}, {x_m, y_m, radians(heading_deg)}, limits);
  }

  World world;
};

TEST_F(Room, ATagAheadIsInSight) {
  const auto seen = seen_from(6.0, 4.0, 0.0);
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->distance_m, 2.0, 1e-9);
  EXPECT_NEAR(seen->slant_rad, 0.0, 1e-9);
  const auto aside = seen_from(6.0, 2.0, 45.0);
  ASSERT_TRUE(aside);
  EXPECT_NEAR(degrees(std::abs(aside->slant_rad)), 45.0, 1e-6);
}

TEST_F(Room, NotBeyondTheLimits) {
  EXPECT_FALSE(seen_from(4.5, 4.0, 0.0)) << "3.5 m away";
  EXPECT_TRUE(seen_from(4.5, 4.0, 0.0, {4.0, radians(60.0)}));
  EXPECT_FALSE(seen_from(7.0, 2.0, 63.0)) << "63 degrees aslant";
}

TEST_F(Room, OnlyWhollyInThePicture) {
  EXPECT_TRUE(seen_from(6.0, 4.0, 25.0));
  EXPECT_FALSE(seen_from(6.0, 4.0, 30.0)) << "across its edge";
  EXPECT_FALSE(seen_from(6.0, 4.0, 180.0)) << "behind the robot";
  world.tags[0].height_m = 1.0;
  EXPECT_FALSE(seen_from(7.2, 4.0, 0.0)) << "above it";
  EXPECT_TRUE(seen_from(5.5, 4.0, 0.0));
}

TEST_F(Room, NotThroughWallsNorHalfHidden) {
  world.walls.push_back({{{7.0, 3.0}, {7.0, 4.02}}, Surface::rough});
  EXPECT_FALSE(seen_from(6.0, 4.0, 0.0)) << "its right half is hidden";
  EXPECT_TRUE(seen_from(6.0, 5.0, -26.0)) << "past the wall's end";
}

TEST_F(Room, NotFromBehind) {
  world.tags[0].T_map_tag = {4.0, 4.0, 0.0};
  EXPECT_FALSE(seen_from(2.5, 4.0, 0.0));
  EXPECT_TRUE(seen_from(5.5, 4.0, 180.0));
}

}  // namespace
}  // namespace cairn
