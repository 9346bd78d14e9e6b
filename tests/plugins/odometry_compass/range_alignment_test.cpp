#include "plugins/odometry_compass/range_alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace cairn::odometry_compass {
namespace {

// Rays all round in a room of 4 x 3 m whose middle is the origin; the last few go astray.
class RangeAlignmentTest : public testing::Test {
 protected:
  static constexpr int kRays = 24;
  static constexpr double kNoise_m = 0.01;

  static double bearing_rad(int i) { return radians(360.0 * i / kRays); }
  // The nearest wall along the ray, and its normal towards the room.
  static std::pair<double, Point> expected(int i, const Pose2& T_map_robot) {
    const double angle_rad = T_map_robot.theta_rad + bearing_rad(i);
    const Point way(std::cos(angle_rad), std::sin(angle_rad));
    const double x_m = ((way.x() > 0.0 ? 2.0 : -2.0) - T_map_robot.x_m) / way.x();
    const double y_m = ((way.y() > 0.0 ? 1.5 : -1.5) - T_map_robot.y_m) / way.y();
    if (std::abs(x_m) < std::abs(y_m)) return {x_m, Point(way.x() > 0.0 ? -1.0 : 1.0, 0.0)};
    return {y_m, Point(0.0, way.y() > 0.0 ? -1.0 : 1.0)};
  }
  void measure(const Pose2& T_map_robot, int astray = 0) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> noise_m(0.0, kNoise_m);
    ranges_m_.clear();
    for (int i = 0; i < kRays; ++i) ranges_m_.push_back(expected(i, T_map_robot).first + noise_m(random));
    for (int i = 0; i < astray; ++i) ranges_m_[static_cast<std::size_t>(5 * i % kRays)] = 0.4;
  }
  // d range / d shift by differences: an oracle that knows no formula.
  [[nodiscard]] RangeResidual residual(int i, const Pose2& T_map_robot) const {
    const double range_m = expected(i, T_map_robot).first;
    constexpr double kStep = 1e-6;
    RangeResidual found{ranges_m_[static_cast<std::size_t>(i)] - range_m, Eigen::Vector3d::Zero(), kNoise_m};
    const Pose2 steps[] = {{kStep, 0.0, 0.0}, {0.0, kStep, 0.0}, {0.0, 0.0, kStep}};
    for (int k = 0; k < 3; ++k) found.per_shift[k] = (expected(i, T_map_robot * steps[k]).first - range_m) / kStep;
    return found;
  }
  [[nodiscard]] std::optional<Alignment> aligned(const Pose2& from, const AlignmentLimits& limits = {}) const {
    return align(
        from, kRays, [&](int i, const Pose2& at) { return std::optional(residual(i, at)); }, limits);
  }

  std::vector<double> ranges_m_;
};

TEST_F(RangeAlignmentTest, FindsTheShiftThatItWasOffBy) {
  const Pose2 truth{0.3, -0.2, radians(20.0)};
  measure(truth);
  for (const Pose2& shift : {Pose2{0.1, 0.0, 0.0}, Pose2{0.0, -0.1, 0.0}, Pose2{0.05, 0.08, radians(-6.0)}, Pose2{}}) {
    const auto found = aligned(truth * inverse(shift));
    ASSERT_TRUE(found);
    const Pose2 off = inverse(shift) * found->T_from_to;
    for (const auto& [error, axis] : {std::pair{off.x_m, 0}, {off.y_m, 1}, {off.theta_rad, 2}})
      EXPECT_LT(std::abs(error), 3.5 * std::sqrt(found->covariance(axis, axis))) << "axis " << axis;
    EXPECT_LT(std::sqrt(found->covariance(0, 0)), 0.01);
    EXPECT_GE(found->readings, kRays - 1);
    EXPECT_LT(found->rms_sigmas, 1.5);
  }
}

TEST_F(RangeAlignmentTest, IsNotPulledByWhatStandsInFront) {
  const Pose2 truth{0.3, -0.2, radians(20.0)};
  measure(truth, 5);
  const auto found = aligned(truth * Pose2{0.05, -0.05, radians(3.0)});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->outliers, 5);
  const Pose2 off = inverse(Pose2{0.05, -0.05, radians(3.0)}) * inverse(found->T_from_to);
  EXPECT_LT(off.position().norm(), 0.02);
}

TEST_F(RangeAlignmentTest, SaysNothingBeyondItsLimits) {
  const Pose2 truth{0.3, -0.2, radians(20.0)};
  measure(truth);
  EXPECT_TRUE(aligned(truth * Pose2{0.2, 0.0, 0.0}));
  EXPECT_FALSE(aligned(truth * Pose2{0.2, 0.0, 0.0}, {.max_shift_m = 0.1})) << "too far";
  EXPECT_FALSE(aligned(truth * Pose2{0.0, 0.0, radians(8.0)}, {.max_turn_rad = radians(5.0)})) << "turned too far";
  measure(truth, 12);
  EXPECT_FALSE(aligned(truth)) << "half of the readings are of something else";
  EXPECT_FALSE(align(truth, 4, [&](int i, const Pose2& at) { return std::optional(residual(i, at)); })) << "too few";
}

// What fits best lies 2 cm ahead, seen from where it then is 2 cm behind, and so on.
TEST_F(RangeAlignmentTest, SaysNothingWhenItDoesNotSettle) {
  int asked = 0;
  EXPECT_FALSE(align({}, kRays, [&](int, const Pose2&) {
    const bool is_forth = (asked++ / kRays) % 2 == 0;
    return std::optional(RangeResidual{is_forth ? 0.02 : -0.02, Eigen::Vector3d(1.0, 0.0, 0.0), 0.02});
  }));
}

TEST_F(RangeAlignmentTest, KeepsWhatNoReadingSpeaksOf) {
  // Of the walls across x only.
  const Pose2 truth{0.3, -0.2, 0.0};
  measure(truth);
  const auto found = align(truth * Pose2{0.06, 0.05, 0.0}, kRays, [&](int i, const Pose2& at) {
    RangeResidual seen = residual(i, at);
    seen.per_shift.y() = seen.per_shift.z() = 0.0;
    return expected(i, at).second.x() != 0.0 ? std::optional(seen) : std::nullopt;
  });
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->T_from_to.y_m, 0.0, 1e-9);
  EXPECT_NEAR(std::sqrt(found->covariance(1, 1)), 1.0, 1e-6);
}

}  // namespace
}  // namespace cairn::odometry_compass
