#include "plugins/baselines/opencv_detectors/pictures.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace cairn::opencv_detectors {
namespace {

LandmarkShape triangle() {
  return {"triangle", Contour::polygon({{0, 0}, {0.6, 0}, {0.3, 0.52}})};
}

// What a perfect tour round the triangle leaves, with a margin of free ground.
OccupancyGrid grid_of(const Contour& contour, double orientation_rad) {
  constexpr int kReach = 15;
  OccupancyGrid grid(0.05);
  const cv::Mat picture = drawn(contour, orientation_rad, 0.05, kReach);
  for (int y = -kReach; y <= kReach; ++y)
    for (int x = -kReach; x <= kReach; ++x) {
      const int ol = picture.at<std::uint8_t>(y + kReach, x + kReach);
      grid.set_log_odds({x, y}, ol == 255 ? 1024 : ol == 0 ? -1024 : 0);
    }
  return grid;
}

TEST(Pictures, RowsGoUpwardsAsTheCellsDo) {
  OccupancyGrid grid(0.05);
  grid.set_log_odds({2, 5}, 1024);
  const cv::Mat picture = picture_of(grid, {{0, 4}, {4, 7}});
  ASSERT_EQ(picture.size(), cv::Size(4, 3));
  EXPECT_EQ(picture.at<std::uint8_t>(1, 2), grid.ol({2, 5}));
  EXPECT_EQ(picture.at<std::uint8_t>(0, 2), kUnknownOl);
}

TEST(Pictures, GradientsOfAPartAreThoseOfTheWhole) {
  const OccupancyGrid grid = grid_of(triangle().contour, 0.3);
  const Gradients whole = gradients_of(grid, {{-16, -16}, {16, 16}});
  const Gradients part = gradients_of(grid, {{-4, -3}, {6, 5}});
  EXPECT_EQ(cv::countNonZero(part.x != whole.x(cv::Rect(12, 13, 10, 8))), 0);
  EXPECT_EQ(cv::countNonZero(part.y != whole.y(cv::Rect(12, 13, 10, 8))), 0);
  EXPECT_GT(cv::countNonZero(part.x), 0);
}

// The host's ideal templates are gradients of just this picture.
TEST(Pictures, ADrawnShapeHasTheGradientsOfItsIdealTemplate) {
  const LandmarkTemplate shape = render_ideal(triangle(), 0.5, 0.05);
  const int reach = reach_of({&shape, 1}) + 2;
  const cv::Mat picture = drawn(triangle().contour, 0.5, 0.05, reach);
  cv::Mat x;
  cv::Sobel(picture, x, CV_16S, 1, 0);
  const Gradients of_template = gradients_of(shape, reach);
  const cv::Mat cells = cells_of(shape, reach);
  ASSERT_GT(cv::countNonZero(cells), 20);
  EXPECT_EQ(cv::countNonZero((x != of_template.x) & cells), 0);
}

TEST(Pictures, EdgesNeedTheirThreshold) {
  const Gradients gradients = gradients_of(grid_of(triangle().contour, 0.0), {{-12, -12}, {13, 13}});
  EXPECT_GT(cv::countNonZero(edges_of(gradients, 300.0, 600.0)), 20);
  EXPECT_EQ(cv::countNonZero(edges_of(gradients, 1139.0, 1140.0)), 0) << "a slope of 1140 is steeper than all here";
}

}  // namespace
}  // namespace cairn::opencv_detectors
