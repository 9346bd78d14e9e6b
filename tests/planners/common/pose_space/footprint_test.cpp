#include "planners/common/pose_space/footprint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "maps/geometry/segments.hpp"
#include "tests/planners/common/pose_space/pose_worlds.hpp"

namespace cairn {
namespace {

using test::Random;
using ::testing::HasSubstr;

const std::vector<Point> kBox{{-0.2, -0.1}, {0.4, -0.1}, {0.4, 0.1}, {-0.2, 0.1}};

TEST(Footprint, KnowsItsCirclesRoundTheOrigin) {
  const Footprint box = Footprint::polygon(kBox);
  EXPECT_NEAR(box.inscribed_m(), 0.1, 1e-12);
  EXPECT_NEAR(box.circumscribed_m(), std::hypot(0.4, 0.1), 1e-12);
  std::vector<Point> ahead = kBox;
  for (Point& corner : ahead) corner.x() += 0.3;
  EXPECT_EQ(Footprint::polygon(ahead).inscribed_m(), 0.0) << "the origin is outside";
  EXPECT_EQ(Footprint::disc(0.3).circumscribed_m(), 0.3);
}

TEST(Footprint, TheCoverHoldsTheOutlineAndNotMuchMore) {
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Footprint outline = test::random_outline(random, trial % 2 == 0);
    for (int k = 0; k < 300; ++k) {
      const double reach_m = outline.circumscribed_m();
      const Point p(test::uniform(random, -reach_m, reach_m), test::uniform(random, -reach_m, reach_m));
      if (!is_inside(outline.corners_m(), p)) continue;
      bool held = false;
      for (const Footprint::Disc& disc : outline.cover())
        held = held || (p - disc.centre).norm() <= disc.radius_m + 1e-12;
      EXPECT_TRUE(held) << p.transpose();
    }
  }
  const Footprint box = Footprint::polygon(kBox);
  for (const Footprint::Disc& disc : box.cover()) EXPECT_LE(disc.radius_m, 0.1 * std::sqrt(1.25) + 1e-9);
}

TEST(Footprint, TouchesTheCellsThatBruteForceFindsNear) {
  Random random(5);
  const Lattice lattice{{0.013, -0.021}, 0.05};
  int near = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Footprint outline = test::random_outline(random, trial % 2 == 0);
    OccupancyGrid grid(lattice.cell_m, 4.0, lattice.origin_m);
    const Cell blocked{std::uniform_int_distribution<int>(-8, 8)(random),
                       std::uniform_int_distribution<int>(-8, 8)(random)};
    grid.set_log_odds(blocked, 900);
    GroundRules rules;
    rules.unknown = UnknownPolicy::allow;
    const Pose2 pose{test::uniform(random, -0.1, 0.1), test::uniform(random, -0.1, 0.1),
                     test::uniform(random, -3.0, 3.0)};
    const double brute_m = test::outline_distance_m(grid, rules, outline, pose, 0.001);
    const double reach_m = test::uniform(random, 1e-6, 0.1);
    if (std::abs(brute_m - reach_m) < 0.0006) continue;
    std::vector<Point> corners;
    for (const Point& corner : outline.corners_m()) corners.push_back(pose * corner);
    const auto free_run = [&](Cell cell) { return cell == blocked ? 0 : 1; };
    EXPECT_EQ(polygon_touches(lattice, corners, reach_m, free_run), brute_m < reach_m) << brute_m << " " << reach_m;
    near += brute_m < reach_m;
  }
  EXPECT_GT(near, 80);
  EXPECT_LT(near, 300);
}

TEST(Footprint, ACellInItsMiddleOrInItsNotchIsDistinguished) {
  const std::vector<Point> u_shape{{-1.0, -1.0}, {1.0, -1.0},  {1.0, 1.0},  {0.5, 1.0},
                                   {0.5, -0.5},  {-0.5, -0.5}, {-0.5, 1.0}, {-1.0, 1.0}};
  const Lattice lattice{{0.0, 0.0}, 0.1};
  const auto touches = [&](Cell blocked) {
    return polygon_touches(lattice, u_shape, kMinRadius_m, [&](Cell cell) { return cell == blocked ? 0 : 1; });
  };
  EXPECT_FALSE(touches({0, 0})) << "in the notch";
  EXPECT_TRUE(touches({0, -8})) << "wholly inside, off the rim";
  EXPECT_TRUE(touches({5, 0})) << "shares a side with the rim";
  EXPECT_TRUE(touches({10, 10})) << "shares a corner";
  EXPECT_FALSE(touches({11, 10}));
}

std::string error_of(const std::vector<Point>& corners) {
  try {
    (void)Footprint::polygon(corners);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(Footprint, BadOutlinesAreRefused) {
  EXPECT_EQ(error_of(kBox), "no error");
  EXPECT_EQ(error_of({{0, 0}, {1, 0}}), "a polygon needs at least 3 corners, this one has 2");
  EXPECT_EQ(error_of({{0, 0}, {1, 0}, {1, NAN}}), "corner 2 of the polygon is not finite");
  EXPECT_THAT(error_of({{0, 0}, {5000, 0}, {1, 1}}), HasSubstr("further than a kilometre"));
  EXPECT_THAT(error_of({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), HasSubstr("from corner 0 and from corner 2 meet"));
  EXPECT_THAT(error_of({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), HasSubstr("corner 2 of the polygon repeats corner 1"));
  EXPECT_THAT(error_of({{0, 0}, {2, 0}, {1, 0}}), HasSubstr("the polygon has no area"));
  EXPECT_THROW((void)Footprint::disc(-0.1), std::invalid_argument);
  EXPECT_THROW((void)Footprint::disc(NAN), std::invalid_argument);
}

}  // namespace
}  // namespace cairn
