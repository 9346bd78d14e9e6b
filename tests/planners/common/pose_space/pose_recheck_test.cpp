#include "planners/common/pose_space/pose_recheck.hpp"

#include <gtest/gtest.h>

#include "planners/common/pose_space/pose_space.hpp"
#include "tests/planners/common/pose_space/motion_measures.hpp"
#include "tests/planners/common/pose_space/pose_worlds.hpp"

namespace cairn {
namespace {

using test::Random;

TEST(PoseRecheck, PassesAllThatWasPlannedWithItsMarginAndNothingThatTouches) {
  Random random(10);
  int planned = 0;
  int touching = 0;
  for (int trial = 0; trial < 40; ++trial) {
    GroundRules rules;
    if (trial % 3 == 0) rules.unknown = UnknownPolicy::allow;
    const OccupancyGrid grid = test::cluttered_grid(random, 40, 0.008);
    const double slack_m = trial % 5 == 0 ? 1e-4 : recheck_slack_m(grid.cell_m());
    const DiscSpace ground(grid, rules);
    const Footprint outline = trial % 7 == 0 ? Footprint::disc(0.12) : test::random_outline(random, trial % 2 == 0);
    const PoseSpace space(ground, outline, planning_margin_m(slack_m));
    for (int k = 0; k < 30; ++k) {
      const Motion motion = test::random_motion(random, test::random_pose(random, grid));
      const auto touch = first_touch(grid, rules, outline, motion, slack_m);
      const bool fits = space.fits_along(motion);
      if (fits) {
        EXPECT_FALSE(touch) << "trial " << trial << " " << k;
      }
      planned += fits;
      if (outline.is_disc()) continue;
      const double brute_m = test::motion_distance_m(grid, rules, outline, motion, 0.004);
      if (brute_m < kMinRadius_m) {
        EXPECT_TRUE(touch) << "trial " << trial << " " << k;
        ++touching;
      } else if (touch) {
        EXPECT_LE(brute_m, slack_m + 0.005) << "trial " << trial << " " << k;
      }
      if (touch) {
        EXPECT_LE(test::outline_distance_m(grid, rules, outline, touch->pose, 0.001), slack_m + 0.0006);
        EXPECT_TRUE(rules.blocks(grid.state(touch->cell)));
      }
    }
  }
  EXPECT_GT(planned, 100);
  EXPECT_GT(touching, 200);
}

TEST(PoseRecheck, NamesTheFirstPlaceThatTouches) {
  OccupancyGrid grid(0.1);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 40; ++x) grid.set_log_odds({x, y}, x == 25 || x == 35 ? LogOdds{900} : LogOdds{-900});
  const Footprint outline = Footprint::polygon({{-0.1, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.1, 0.1}});
  const Motion motion({0.5, 0.5, 0.0}, {MotionElement::straight(3.0)});
  const auto touch = first_touch(grid, {}, outline, motion, 0.001);
  ASSERT_TRUE(touch);
  EXPECT_NEAR(touch->s_m, 2.5 - 0.2 - 0.5, 0.002);
  EXPECT_EQ(touch->cell.x, 25);
  EXPECT_FALSE(first_touch(grid, {}, outline, test::first_part(motion, 1.79), 0.001));
}

TEST(PoseRecheck, FindsACellInsideTheOutline) {
  OccupancyGrid grid(0.1);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 30; ++x) grid.set_log_odds({x, y}, x == 15 && y == 15 ? LogOdds{900} : LogOdds{-900});
  const Footprint outline = Footprint::polygon({{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}});
  const auto touch = first_touch(grid, {}, outline, Motion({1.5, 1.5, 0.3}), 0.001);
  ASSERT_TRUE(touch);
  EXPECT_EQ(touch->cell, (Cell{15, 15}));
}

TEST(PoseRecheck, RefusesNumbersThatAreNotFiniteAndASlackOfNothing) {
  const OccupancyGrid grid(0.1);
  const Footprint outline = Footprint::disc(0.1);
  GroundRules rules;
  rules.unknown = UnknownPolicy::allow;
  EXPECT_TRUE(first_touch(grid, rules, outline, Motion({NAN, 0.0, 0.0}), 0.001));
  EXPECT_FALSE(first_touch(grid, rules, outline, Motion({0.0, 0.0, 0.0}), 0.001));
  EXPECT_THROW((void)first_touch(grid, {}, outline, Motion(), 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace cairn
