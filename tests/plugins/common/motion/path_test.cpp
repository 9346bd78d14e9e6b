#include "plugins/common/motion/path.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace cairn::motion {
namespace {

TEST(Path, HasPointsAlongIt) {
  const std::vector<Point> path{{0, 0}, {1, 0}, {1, 2}};
  EXPECT_DOUBLE_EQ(length_of(path), 3.0);
  EXPECT_EQ(point_along(path, -1.0), Point(0, 0));
  EXPECT_EQ(point_along(path, 0.5), Point(0.5, 0));
  EXPECT_EQ(point_along(path, 2.0), Point(1, 1));
  EXPECT_EQ(point_along(path, 9.0), Point(1, 2));
}

TEST(Path, TheNearestPointIsLookedForInAPartOfItOnly) {
  const std::vector<Point> there_and_back{{0, 0}, {2, 0}, {2, 0.1}, {0, 0.1}};
  EXPECT_DOUBLE_EQ(nearest_on(there_and_back, {0.5, 0.06}, 0.0, 1.0).along_m, 0.5);
  EXPECT_DOUBLE_EQ(nearest_on(there_and_back, {0.5, 0.06}, 2.0, 5.0).along_m, 3.6);
  EXPECT_DOUBLE_EQ(nearest_on(there_and_back, {0.5, 0.06}, 9.0, 10.0).along_m, length_of(there_and_back));
}

TEST(Path, TheHeadingErrorIsAnticlockwise) {
  EXPECT_NEAR(heading_error({0, 0, 0}, {1, 1}), std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(heading_error({0, 0, 3.0}, {-1, -0.1}), wrap_angle(std::atan2(-0.1, -1.0) - 3.0), 1e-12);
  EXPECT_EQ(heading_error({1, 1, 2}, {1, 1}), 0.0) << "there";
}

}  // namespace
}  // namespace cairn::motion
