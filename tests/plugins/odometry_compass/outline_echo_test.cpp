#include "plugins/odometry_compass/outline_echo.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cairn::odometry_compass {
namespace {

constexpr double kHalfBeam_rad = radians(15.0);
const Contour kSquare = Contour::polygon({{-0.25, -0.25}, {0.25, -0.25}, {0.25, 0.25}, {-0.25, 0.25}});
const Contour kCircle = Contour::circle(0.6);

TEST(OutlineEcho, OfACircleIsItsNearestPointWhereverInTheBeam) {
  for (const double off_rad : {0.0, radians(10.0), radians(-13.0)}) {
    const auto echo = expected_echo(kCircle, {-2.0, 0.0, off_rad}, kHalfBeam_rad);
    ASSERT_TRUE(echo);
    EXPECT_NEAR(echo->range_m, 1.7, 1e-12);
    EXPECT_NEAR(echo->per_position.x(), -1.0, 1e-12) << "nearer by as much as it goes ahead";
  }
  EXPECT_FALSE(expected_echo(kCircle, {-2.0, 0.0, radians(20.0)}, kHalfBeam_rad));
  EXPECT_FALSE(expected_echo(kCircle, {0.1, 0.0, 0.0}, kHalfBeam_rad)) << "from inside";
}

TEST(OutlineEcho, OfAFaceIsThePerpendicularAndOfAnEdgeTheCorner) {
  const auto face = expected_echo(kSquare, {-1.25, 0.1, radians(12.0)}, kHalfBeam_rad);
  ASSERT_TRUE(face);
  EXPECT_NEAR(face->range_m, 1.0, 1e-12);
  const auto corner = expected_echo(kSquare, {-1.25, -1.25, radians(45.0)}, kHalfBeam_rad);
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->range_m, std::sqrt(2.0), 1e-12);
}

TEST(OutlineEcho, IsNoneWhereAFaceLeavesTheBeam) {
  // The perpendicular is 30 degrees off: what the rim meets is a matter of loudness.
  EXPECT_FALSE(expected_echo(Contour::polygon({{0.0, -3.0}, {1.0, -3.0}, {1.0, 3.0}, {0.0, 3.0}}),
                             {-1.5, 0.0, radians(30.0)}, kHalfBeam_rad));
}

TEST(OutlineEcho, OfARayIsWhereItCrossesFirst) {
  const auto echo = expected_echo(kSquare, {-1.25, 0.0, radians(5.0)}, 0.0);
  ASSERT_TRUE(echo);
  EXPECT_NEAR(echo->range_m, 1.0 / std::cos(radians(5.0)), 1e-12);
  EXPECT_FALSE(expected_echo(kSquare, {-1.25, 0.0, radians(30.0)}, 0.0));
}

TEST(OutlineEcho, ChangesAsItsSlopesSay) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const Contour& contour = i % 2 == 0 ? kSquare : kCircle;
    const double half_beam_rad = i % 4 < 2 ? 0.0 : kHalfBeam_rad;
    const Pose2 at{2.0 * any(random), 2.0 * any(random), 3.1 * any(random)};
    const auto echo = expected_echo(contour, at, half_beam_rad);
    constexpr double kStep = 1e-6;
    const auto ahead = expected_echo(contour, {at.x_m + kStep, at.y_m, at.theta_rad}, half_beam_rad);
    const auto aside = expected_echo(contour, {at.x_m, at.y_m + kStep, at.theta_rad}, half_beam_rad);
    const auto turned = expected_echo(contour, {at.x_m, at.y_m, at.theta_rad + kStep}, half_beam_rad);
    if (!echo || !ahead || !aside || !turned) continue;
    EXPECT_NEAR((ahead->range_m - echo->range_m) / kStep, echo->per_position.x(), 1e-4);
    EXPECT_NEAR((aside->range_m - echo->range_m) / kStep, echo->per_position.y(), 1e-4);
    EXPECT_NEAR((turned->range_m - echo->range_m) / kStep, echo->per_heading_m, 1e-4);
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace cairn::odometry_compass
