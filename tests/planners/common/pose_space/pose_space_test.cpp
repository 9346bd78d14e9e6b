#include "planners/common/pose_space/pose_space.hpp"

#include <gtest/gtest.h>

#include "tests/planners/common/pose_space/motion_measures.hpp"
#include "tests/planners/common/pose_space/pose_worlds.hpp"
#include "tests/planners/drawn_world.hpp"

namespace cairn {
namespace {

using test::drawn_world;
using test::Random;

constexpr double kStep_m = 0.004;

GroundRules rules_for(int trial) {
  GroundRules rules;
  if (trial % 3 == 0) rules.unknown = UnknownPolicy::allow;
  return rules;
}

bool stays_on(const DiscSpace& ground, const Motion& motion) {
  for (const Pose2& pose : motion.sampled(0.01, 0.1))
    if (!ground.contains(pose.position())) return false;
  return true;
}

TEST(PoseSpace, AnOutlineFitsWhereBruteForceFindsNothingNear) {
  Random random(6);
  int fitting = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const GroundRules rules = rules_for(trial);
    const OccupancyGrid grid = test::cluttered_grid(random, 40, 0.015);
    const DiscSpace ground(grid, rules);
    const double margin_m = trial % 2 == 0 ? kMinRadius_m : 0.01;
    const PoseSpace space(ground, test::random_outline(random, trial % 4 < 2), margin_m);
    for (int k = 0; k < 40; ++k) {
      const Pose2 pose = test::random_pose(random, grid);
      const double brute_m = test::outline_distance_m(grid, rules, space.footprint(), pose, 0.001);
      if (brute_m > margin_m && brute_m < margin_m + 0.0005) continue;  // brute force cannot decide
      EXPECT_EQ(space.fits(pose), brute_m > margin_m) << brute_m;
      fitting += brute_m > margin_m;
    }
  }
  EXPECT_GT(fitting, 300);
  EXPECT_LT(fitting, 1400);
}

TEST(PoseSpace, NoMotionThatTouchesIsAcceptedAndNoneThatKeepsItsDistanceRefused) {
  Random random(7);
  int fitting = 0;
  int asked = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const GroundRules rules = rules_for(trial);
    const OccupancyGrid grid = test::cluttered_grid(random, 40, 0.008);
    const DiscSpace ground(grid, rules);
    const double margin_m = trial % 2 == 0 ? kMinRadius_m : 0.008;
    const PoseSpace space(ground, test::random_outline(random, trial % 4 < 2), margin_m);
    for (int k = 0; k < 30; ++k) {
      const Pose2 start = test::random_pose(random, grid);
      if (!space.fits(start)) continue;
      const Motion motion = test::random_motion(random, start);
      const double brute_m = test::motion_distance_m(grid, rules, space.footprint(), motion, kStep_m);
      const bool fits = space.fits_along(motion);
      if (fits) {
        EXPECT_GE(brute_m, margin_m) << "trial " << trial << " " << k;
      } else if (stays_on(ground, motion)) {
        // Half a step between poses, and half between points of the rim.
        EXPECT_LE(brute_m, margin_m + space.bend_slack_m() + kStep_m) << "trial " << trial << " " << k;
      }
      fitting += fits;
      ++asked;
    }
  }
  EXPECT_GT(fitting, 100);
  EXPECT_LT(fitting, asked - 100);
}

TEST(PoseSpace, TheShareThatFitsIsTheLongestThatDoes) {
  Random random(8);
  int stopped = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const OccupancyGrid grid = test::cluttered_grid(random, 40, 0.008);
    const DiscSpace ground(grid, {});
    const PoseSpace space(ground, test::random_outline(random, trial % 2 == 0));
    for (int k = 0; k < 30; ++k) {
      const Motion motion = test::random_motion(random, test::random_pose(random, grid));
      const double share = space.share_that_fits(motion);
      EXPECT_EQ(share == 1.0, space.fits_along(motion));
      if (!space.fits(motion.start())) {
        EXPECT_EQ(share, 0.0);
        continue;
      }
      const double extent_m = motion.extent_m();
      EXPECT_TRUE(space.fits_along(test::first_part(motion, (share - 1e-9) * extent_m)));
      if (share == 1.0) continue;
      EXPECT_FALSE(space.fits_along(test::first_part(motion, share * extent_m + 0.1)));
      ++stopped;
    }
  }
  EXPECT_GT(stopped, 50);
}

TEST(PoseSpace, ADiscMovesLikeTheDiscOfTheDiscSpace) {
  Random random(9);
  const OccupancyGrid grid = test::cluttered_grid(random, 60, 0.02);
  const DiscSpace ground(grid, {});
  const PoseSpace space(ground, Footprint::disc(0.1));
  for (int k = 0; k < 500; ++k) {
    const Pose2 from = test::random_pose(random, grid);
    const Pose2 to = test::random_pose(random, grid);
    EXPECT_EQ(space.fits_along(turn_drive_turn(from, to)),
              ground.fits_along(from.position(), to.position(), 0.1 + kMinRadius_m));
    EXPECT_EQ(space.fits_along(Motion(from, {MotionElement::turn(2.0)})), space.fits(from));
    // A half circle, against its chords: they keep within the sagitta.
    const Motion bend(from, {MotionElement::arc(0.15, radians(180.0))});
    bool chords = true;
    const double sagitta_m = 0.15 * (1.0 - std::cos(radians(0.5)));
    for (double s_m = 0.0; s_m < bend.extent_m(); s_m += bend.extent_m() / 180.0)
      chords = chords &&
               ground.fits_along(bend.pose_at(s_m).position(), bend.pose_at(s_m + bend.extent_m() / 180.0).position(),
                                 0.1 + space.bend_slack_m() + kMinRadius_m + sagitta_m);
    if (chords) {
      EXPECT_TRUE(space.fits_along(bend));
    }
  }
}

const char* const kCorridor =
    "####################\n"
    "#..................#\n"
    "#..................#\n"
    "#..................#\n"
    "####################\n";

TEST(PoseSpace, ACorridorAsWideAsTheRobotLetsItStraightThroughButNotTurn) {
  const auto world = drawn_world(kCorridor);  // 0.3 m wide
  const DiscSpace ground(world.grid, {});
  const auto box = [](double width_m) {
    return Footprint::polygon(
        {{-0.1, -0.5 * width_m}, {0.3, -0.5 * width_m}, {0.3, 0.5 * width_m}, {-0.1, 0.5 * width_m}});
  };
  const Pose2 start{0.25, 0.25, 0.0};
  const Motion ahead(start, {MotionElement::straight(1.3)});
  EXPECT_TRUE(PoseSpace(ground, box(0.29999)).fits_along(ahead));
  EXPECT_FALSE(PoseSpace(ground, box(0.3)).fits_along(ahead)) << "it would touch both walls";
  EXPECT_FALSE(PoseSpace(ground, box(0.29999)).fits_along(Motion(start, {MotionElement::straight(1.4)})));
  const PoseSpace thin(ground, box(0.1));
  EXPECT_TRUE(thin.fits_along(Motion(start, {MotionElement::turn(0.3)})));
  EXPECT_FALSE(thin.fits_along(Motion(start, {MotionElement::turn(3.1)}))) << "its nose sweeps through the wall";
  EXPECT_TRUE(thin.fits({1.0, 0.25, 3.1}));
}

TEST(PoseSpace, AThinWallIsNeverCut) {
  const auto world = drawn_world(
      "...........#...........\n"
      "...........#...........\n"
      "...........#...........\n",
      0.05);
  const DiscSpace ground(world.grid, {});
  const PoseSpace space(ground, Footprint::polygon({{-0.01, -0.01}, {0.01, -0.01}, {0.0, 0.01}}));
  for (double y = 0.03; y < 0.12; y += 0.01) {
    const Pose2 from{0.05, y, 0.0};
    EXPECT_TRUE(space.fits(from));
    EXPECT_FALSE(space.fits_along(turn_drive_turn(from, {1.1, 0.15 - y, 0.0})));
    const Motion round(from, {{1.05, 0.1}});
    EXPECT_NEAR(space.share_that_fits(round) * 1.05, 0.49, 0.01) << "stops with its nose before the wall";
  }
}

TEST(PoseSpace, NothingFitsOutsideTheMapOrAtNumbersThatAreNotFinite) {
  const auto world = drawn_world(".....\n.....\n.....\n");
  for (const UnknownPolicy unknown : {UnknownPolicy::avoid, UnknownPolicy::allow}) {
    GroundRules rules;
    rules.unknown = unknown;
    const DiscSpace ground(world.grid, rules);
    const PoseSpace space(ground, Footprint::polygon({{-0.1, -0.1}, {0.1, -0.1}, {0.0, 0.1}}));
    EXPECT_TRUE(space.fits({0.25, 0.15, 0.0}));
    EXPECT_FALSE(space.fits({1e12, -1e12, 0.0}));
    EXPECT_FALSE(space.fits({NAN, 0.1, 0.0}));
    EXPECT_FALSE(space.fits({0.25, 0.15, NAN}));
    for (const double far_m : {5.0, 1e12, 1e300, double(INFINITY), double(NAN)})
      EXPECT_FALSE(space.fits_along(Motion({0.25, 0.15, 0.0}, {MotionElement::straight(far_m)})));
    EXPECT_FALSE(space.fits_along(Motion({0.25, 0.15, 0.0}, {MotionElement::arc(2.0, 6.28)})));
  }
}

}  // namespace
}  // namespace cairn
