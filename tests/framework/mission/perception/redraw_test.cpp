#include "framework/mission/perception/redraw.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cairn {
namespace {

TEST(DrawnFrame, IsTheLocalizersAsLongAsTheMapIsGoodEnough) {
  DrawnFrame frame;
  EXPECT_EQ(frame.T_drawn_map(), Pose2{});
  frame.correct(DrawnFrame::kRedrawAfter_m, {1.0, 0.0, 0.0}, {1.2, 0.0, 0.0});
  EXPECT_FALSE(frame.is_outdated());
  EXPECT_EQ(frame.T_drawn_map(), Pose2{});
}

TEST(DrawnFrame, StaysWhereTheMapIsUntilItIsDrawnAnew) {
  DrawnFrame frame;
  const Pose2 T_drawn_last{3.0, 1.0, 0.5};
  const Pose2 T_map_last{3.5, 0.5, 0.7};
  frame.correct(2.0, T_drawn_last, T_map_last);
  EXPECT_TRUE(frame.is_outdated());
  const Pose2 step{0.2, 0.0, 0.1};
  const Pose2 off = inverse(T_drawn_last * step) * (frame.T_drawn_map() * (T_map_last * step));
  EXPECT_LT(off.position().norm() + std::abs(off.theta_rad), 1e-12);
  frame.correct(0.1, T_drawn_last, T_map_last);
  EXPECT_FALSE(frame.is_outdated()) << "a second thought";
}

TEST(DrawnFrame, TheCovarianceTurnsWithTheFrame) {
  PoseEstimate estimate;
  estimate.covariance.diagonal() << 0.04, 0.01, 0.001;
  const PoseEstimate turned = moved({0.0, 0.0, radians(90.0)}, estimate);
  EXPECT_NEAR(turned.covariance(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(turned.covariance(1, 1), 0.04, 1e-12);
  EXPECT_NEAR(turned.T_map_robot.theta_rad, radians(90.0), 1e-12);
}

TEST(CellsOf, AConeHasMoreThanARayAndNoEchoIsAsFarAsTheSensorHears) {
  const auto seen = [](double range_m, double half_beam_rad) {
    Observation observation;
    observation.ranges.push_back({{}, half_beam_rad, 0.1, 5.0, range_m, 0});
    return observation;
  };
  EXPECT_LT(cells_of(seen(3.0, 0.0), 0.1), cells_of(seen(3.0, 0.2), 0.1));
  EXPECT_LT(cells_of(seen(3.0, 0.0), 0.1), cells_of(seen(3.0, 0.0), 0.05));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(cells_of(seen(infinity, 0.1), 0.1), cells_of(seen(5.0, 0.1), 0.1));
  EXPECT_EQ(cells_of(seen(std::nan(""), 0.1), 0.1), cells_of(seen(5.0, 0.1), 0.1));
}

}  // namespace
}  // namespace cairn
