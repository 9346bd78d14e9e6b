#include "framework/experiments/recognition/ring_profile.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

// A ring of occupied cells about the origin, between two distances from a circle's outline.
OccupancyGrid ring(double radius_m, double inner_m, double outer_m) {
  OccupancyGrid grid(0.01);
  for (int y = -80; y <= 80; ++y)
    for (int x = -80; x <= 80; ++x) {
      const double distance_m = grid.centre_of({x, y}).norm() - radius_m;
      const int log_odds = distance_m < inner_m ? 0 : distance_m < outer_m ? 1024 : -1024;
      grid.set_log_odds({x, y}, static_cast<LogOdds>(log_odds));
    }
  return grid;
}

World one_circle(double diameter_m) {
  World world;
  world.objects = {{"circle", Contour::circle(diameter_m), {}, Surface::rough}};
  return world;
}

TEST(RingProfile, FindsTheRingWhereItIsPainted) {
  for (const double offset_m : {-0.05, 0.0, 0.04, 0.1}) {
    const RingProfile profile = ring_profile(ring(0.3, offset_m - 0.03, offset_m + 0.03), one_circle(0.6));
    EXPECT_NEAR(profile.ring_at_m(), offset_m, 0.003);
  }
}

TEST(RingProfile, OfAMapWithoutARingLiesOnTheOutline) {
  EXPECT_EQ(ring_profile(OccupancyGrid(0.05), one_circle(0.6)).ring_at_m(), 0.0);
}

TEST(RingProfile, LeavesOutWhatIsNoLandmark) {
  World world = one_circle(0.6);
  world.objects[0].category.clear();
  for (const std::int64_t cells : ring_profile(OccupancyGrid(0.05), world).cells) EXPECT_EQ(cells, 0);
}

}  // namespace
}  // namespace cairn
