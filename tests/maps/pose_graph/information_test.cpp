#include "maps/pose_graph/information.hpp"

#include <gtest/gtest.h>

#include "maps/geometry/pose.hpp"

namespace cairn {
namespace {

TEST(WithFloor, NothingIsMeasuredBetterThanTheFloorAndNothingStaysNothing) {
  const Eigen::Matrix3d floored = with_floor(1e12 * Eigen::Matrix3d::Identity(), 0.02, 0.01);
  EXPECT_NEAR(floored(0, 0), 2500.0, 1.0);
  EXPECT_NEAR(floored(2, 2), 10000.0, 1.0);
  EXPECT_LT(with_floor(Eigen::Matrix3d::Zero(), 0.02, 0.01).norm(), 1e-5);
}

TEST(InformationInTurned, TheSameSpreadIsSeenFromATurnedFrame) {
  Eigen::Matrix3d information = Eigen::Vector3d(100.0, 1.0, 10.0).asDiagonal();
  const Eigen::Matrix3d turned = information_in_turned(information, radians(90.0));
  EXPECT_NEAR(turned(0, 0), 1.0, 1e-9);
  EXPECT_NEAR(turned(1, 1), 100.0, 1e-9);
  EXPECT_NEAR(turned(2, 2), 10.0, 1e-9);
}

}  // namespace
}  // namespace cairn
