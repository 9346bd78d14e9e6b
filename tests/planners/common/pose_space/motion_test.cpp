#include "planners/common/pose_space/motion.hpp"

#include <gtest/gtest.h>

#include "tests/planners/common/pose_space/motion_measures.hpp"
#include "tests/planners/common/pose_space/pose_worlds.hpp"

namespace cairn {
namespace {

using test::Random;

void expect_same(const Pose2& a, const Pose2& b, double within = 1e-9) {
  EXPECT_NEAR(a.x_m, b.x_m, within);
  EXPECT_NEAR(a.y_m, b.y_m, within);
  EXPECT_NEAR(wrap_angle(a.theta_rad - b.theta_rad), 0.0, within);
}

TEST(Motion, AQuarterCircleEndsWhereGeometrySays) {
  const Motion left({1.0, 2.0, 0.0}, {MotionElement::arc(3.0, radians(90.0))});
  expect_same(left.end(), {4.0, 5.0, radians(90.0)});
  EXPECT_NEAR(left.length_m(), 1.5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(test::min_radius_m(left), 3.0, 1e-12);
  // Backwards with the wheels to the left the centre stays on the left, and the heading turns clockwise.
  const Motion reverse({1.0, 2.0, 0.0}, {MotionElement::arc(3.0, radians(-90.0), false)});
  expect_same(reverse.end(), {-2.0, 5.0, radians(-90.0)});
  EXPECT_NEAR(reverse.elements().front().signed_radius_m(), 3.0, 1e-12);
}

TEST(Motion, PosesSolveTheEquationsOfMotion) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Motion motion = test::random_motion(random, {0.3, -0.2, test::uniform(random, -3.0, 3.0)});
    Pose2 pose = motion.start();
    for (const MotionElement& element : motion.elements())
      for (int k = 0; k < 4000; ++k) {  // midpoint rule
        const double middle_rad = pose.theta_rad + element.turn_rad / 8000.0;
        pose.x_m += element.length_m / 4000.0 * std::cos(middle_rad);
        pose.y_m += element.length_m / 4000.0 * std::sin(middle_rad);
        pose.theta_rad += element.turn_rad / 4000.0;
      }
    expect_same(motion.end(), pose, 1e-7);
  }
}

TEST(Motion, PartsOfAMotionEndOnIt) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Motion motion = test::random_motion(random, {0.3, -0.2, 0.4});
    const double s_m = test::uniform(random, 0.0, motion.extent_m());
    const Motion part = test::first_part(motion, s_m);
    EXPECT_NEAR(part.extent_m(), s_m, 1e-12);
    expect_same(part.end(), motion.pose_at(s_m));
    expect_same(part.pose_at(0.5 * s_m), motion.pose_at(0.5 * s_m));
    EXPECT_EQ(motion.pose_at(-1.0), motion.start());
    EXPECT_EQ(motion.pose_at(motion.extent_m() + 1.0), motion.end());
  }
}

TEST(Motion, SamplesLieOnItNoFurtherApartThanAskedWithAllEndsOfElements) {
  const Motion motion({0.0, 0.0, 0.0}, {MotionElement::straight(-1.0), MotionElement::turn(2.0),
                                        MotionElement::arc(0.5, -1.0), MotionElement::straight(0.0)});
  ASSERT_EQ(motion.elements().size(), 3U) << "what does nothing is left out";
  const std::vector<Pose2> poses = motion.sampled(0.03, 0.05);
  EXPECT_EQ(poses.front(), motion.start());
  EXPECT_EQ(poses.back(), motion.end());
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_LE((poses[i].position() - poses[i - 1].position()).norm(), 0.03 + 1e-12);
    EXPECT_LE(std::abs(wrap_angle(poses[i].theta_rad - poses[i - 1].theta_rad)), 0.05 + 1e-12);
  }
  for (std::size_t i = 0; i < motion.elements().size(); ++i)
    EXPECT_NE(std::find(poses.begin(), poses.end(), motion.start_of(i)), poses.end());
  EXPECT_NEAR(motion.length_m(), 1.5, 1e-12);
  EXPECT_NEAR(test::total_turn_rad(motion), 3.0, 1e-12);
  EXPECT_NEAR(motion.spot_turn_rad(), 2.0, 1e-12);
  EXPECT_NEAR(motion.extent_m(), 3.5, 1e-12);
  EXPECT_EQ(motion.reversals(), 1);
}

TEST(TurnDriveTurn, EndsAtTheOtherPoseAndDrivesStraight) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const auto pose = [&] {
      return Pose2{test::uniform(random, -2.0, 2.0), test::uniform(random, -2.0, 2.0),
                   test::uniform(random, -3.1, 3.1)};
    };
    const Pose2 from = pose();
    const Pose2 to = pose();
    double turns_rad[3];
    for (const Driving driving : {Driving::forwards, Driving::backwards, Driving::either}) {
      const Motion motion = turn_drive_turn(from, to, driving);
      expect_same(motion.end(), to);
      EXPECT_NEAR(turn_drive_turn_m(from, to, driving), motion.extent_m(), 1e-12);
      EXPECT_NEAR(motion.length_m(), (to.position() - from.position()).norm(), 1e-12);
      if (driving != Driving::either) {
        EXPECT_EQ(motion.elements()[1].length_m > 0.0, driving == Driving::forwards);
      }
      turns_rad[static_cast<int>(driving)] = test::total_turn_rad(motion);
    }
    EXPECT_EQ(turns_rad[2], std::min(turns_rad[0], turns_rad[1]));
  }
  EXPECT_TRUE(turn_drive_turn({1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}).elements().empty());
  expect_same(turn_drive_turn({1.0, 1.0, 3.0}, {1.0, 1.0, -3.0}).end(), {1.0, 1.0, -3.0});
}

TEST(Motion, RefusesATurnThatCountsNothing) {
  EXPECT_THROW(Motion({}, {MotionElement::turn(1.0)}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace cairn
