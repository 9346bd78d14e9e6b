#include "maps/geometry/pose.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace cairn {
namespace {

constexpr double kPi = std::numbers::pi;

Pose2 random_pose(std::mt19937_64& random) {
  std::uniform_real_distribution<double> metres(-20.0, 20.0);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  return {metres(random), metres(random), angle(random)};
}

void expect_near(const Pose2& a, const Pose2& b) {
  EXPECT_NEAR(a.x_m, b.x_m, 1e-12);
  EXPECT_NEAR(a.y_m, b.y_m, 1e-12);
  EXPECT_NEAR(wrap_angle(a.theta_rad - b.theta_rad), 0.0, 1e-12);
}

TEST(WrapAngle, KeepsAnglesWithinMinusPiExcludedAndPiIncluded) {
  EXPECT_EQ(wrap_angle(kPi), kPi);
  EXPECT_EQ(wrap_angle(-kPi), kPi);
  EXPECT_EQ(wrap_angle(0.0), 0.0);
  EXPECT_EQ(wrap_angle(std::nextafter(-kPi, 0.0)), std::nextafter(-kPi, 0.0));
  for (int turns = -5; turns <= 5; ++turns) EXPECT_NEAR(wrap_angle(1.25 + 2.0 * kPi * turns), 1.25, 1e-12);
  for (double angle = -50.0; angle < 50.0; angle += 0.37) {
    EXPECT_GT(wrap_angle(angle), -kPi);
    EXPECT_LE(wrap_angle(angle), kPi);
  }
}

TEST(Vectors, TurnToTheLeftByAQuarter) {
  EXPECT_EQ(to_left({1.0, 2.0}), Point(-2.0, 1.0));
  EXPECT_NEAR((to_left(unit_vector(0.3)) - unit_vector(0.3 + kPi / 2.0)).norm(), 0.0, 1e-15);
}

TEST(Vectors, CrossIsPositiveToTheLeft) {
  EXPECT_GT(cross({1.0, 0.0}, {1.0, 1.0}), 0.0);
  EXPECT_LT(cross({1.0, 0.0}, {1.0, -1.0}), 0.0);
  EXPECT_EQ(cross({1.0, 2.0}, {2.0, 4.0}), 0.0);
}

TEST(Pose2, IsFiniteWhenEachOfItsNumbersIs) {
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_finite({1.0, 2.0, 3.0}));
  EXPECT_FALSE(is_finite({infinite, 2.0, 3.0}));
  EXPECT_FALSE(is_finite({1.0, -infinite, 3.0}));
  EXPECT_FALSE(is_finite({1.0, 2.0, std::numeric_limits<double>::quiet_NaN()}));
}

TEST(Angles, GoToDegreesAndBack) {
  EXPECT_DOUBLE_EQ(radians(180.0), kPi);
  EXPECT_DOUBLE_EQ(degrees(radians(37.5)), 37.5);
}

TEST(Pose2, KeepsTheLawsOfAGroup) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 500; ++i) {
    const Pose2 a = random_pose(random);
    const Pose2 b = random_pose(random);
    const Pose2 c = random_pose(random);
    expect_near(a * inverse(a), Pose2{});
    expect_near(inverse(a) * a, Pose2{});
    expect_near(a * Pose2{}, a);
    expect_near((a * b) * c, a * (b * c));
    expect_near(inverse(a * b), inverse(b) * inverse(a));
  }
}

TEST(Pose2, TakesPointsAsItTakesPoses) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 500; ++i) {
    const Pose2 T_a_b = random_pose(random);
    const Pose2 T_b_c = random_pose(random);
    const Point p_c = random_pose(random).position();
    EXPECT_LT(((T_a_b * T_b_c) * p_c - T_a_b * (T_b_c * p_c)).norm(), 1e-12);
    EXPECT_LT((T_a_b * Point(1.0, 0.0) - T_a_b.position() - T_a_b.direction()).norm(), 1e-12);
  }
}

TEST(Pose2, TurnsAnticlockwise) {
  const Point p = Pose2{1.0, 2.0, kPi / 2.0} * Point(3.0, 0.0);
  EXPECT_NEAR(p.x(), 1.0, 1e-12);
  EXPECT_NEAR(p.y(), 5.0, 1e-12);
}

}  // namespace
}  // namespace cairn
