#include "plugins/common/motion/velocity.hpp"

#include <gtest/gtest.h>

namespace cairn::motion {
namespace {

TEST(Velocity, ApproachesItsTargetWithinTheAccelerations) {
  const Accelerations limits;
  const Twist next = approached({0.0, 0.0}, {0.25, -0.9}, 0.04, limits);
  EXPECT_NEAR(next.v_mps, 0.02, 1e-12);
  EXPECT_NEAR(next.w_radps, -0.14, 1e-12);
  EXPECT_EQ(approached({0.24, 0.1}, {0.25, 0.1}, 0.04, limits), (Twist{0.25, 0.1}));
}

TEST(Velocity, ACarKeepsItsTurningRadiusWhileItSlowsDown) {
  Accelerations limits;
  limits.min_turning_radius_m = 0.5;
  const Twist next = approached({0.2, 0.4}, {0.0, 0.4}, 0.2, limits);
  EXPECT_LE(std::abs(next.w_radps) * 0.5, next.v_mps + 1e-12);
}

TEST(Velocity, NoTurnIsNeededWhenItIsAimed) {
  EXPECT_EQ(turn_by(radians(1.0), 1.0), Twist{});
  EXPECT_EQ(turn_by(radians(90.0), 1.0), (Twist{0.0, 1.0}));
  EXPECT_NEAR(turn_by(radians(-10.0), 1.0).w_radps, -2.0 * radians(10.0), 1e-12);
}

}  // namespace
}  // namespace cairn::motion
