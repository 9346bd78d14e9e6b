#include "plugins/baselines/opencv_detectors/searching_detector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "plugins/baselines/opencv_detectors/chamfer.hpp"
#include "plugins/baselines/opencv_detectors/generalized_hough.hpp"
#include "plugins/baselines/opencv_detectors/match_template.hpp"

namespace cairn::opencv_detectors {
namespace {

constexpr double kCell_m = 0.05;

std::shared_ptr<const TemplateSet> templates() {
  static const auto kSet = std::make_shared<const TemplateSet>(
      render_ideal_set({{"circle", Contour::circle(0.5)},
                        {"square", Contour::polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}})},
                        {"triangle", Contour::polygon({{0, 0}, {0.6, 0}, {0.3, 0.52}})}},
                       radians(15.0), kCell_m));
  return kSet;
}

// Free ground of 5 x 3 m with landmarks on it.
OccupancyGrid grid_with(const std::vector<std::pair<std::size_t, Pose2>>& landmarks) {
  OccupancyGrid grid(kCell_m);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 100; ++x) {
      double nearest = 100.0;
      for (const auto& [shape, T_map_shape] : landmarks)
        nearest = std::min(
            nearest, templates()->shapes[shape].contour.signed_distance(inverse(T_map_shape) * grid.centre_of({x, y})));
      const double cells = nearest / kCell_m;
      grid.set_log_odds({x, y}, cells >= 0.999 ? -1024 : cells > -1.499 ? 1024 : 0);
    }
  return grid;
}

std::vector<Detection> found_by(Detector& detector, const OccupancyGrid& grid, const CellBox& changed) {
  std::vector<Detection> found;
  for (const Matching& matching : detector.detect(grid, everything_in(changed), Budget{}).matchings)
    if (matching.detection) found.push_back(*matching.detection);
  return found;
}

Candidate candidate(double x_m, double degree, std::size_t index = 0) {
  return {{x_m, 0.0}, index, 0.0, degree};
}

TEST(StrongestOf, TheBetterOfTwoThatStandInEachOthersWayStays) {
  const auto strongest = strongest_of({candidate(1.2, 0.5), candidate(1.0, 0.9), candidate(2.0, 0.4)}, 0.5);
  ASSERT_EQ(strongest.size(), 2U);
  EXPECT_DOUBLE_EQ(strongest[0].best.degree, 0.9);
  ASSERT_EQ(strongest[0].weaker.size(), 1U);
  EXPECT_DOUBLE_EQ(strongest[0].weaker[0].degree, 0.5);
  EXPECT_DOUBLE_EQ(strongest[1].best.degree, 0.4);
}

TEST(StrongestOf, OfEqualOnesTheEarlierTemplateStays) {
  const auto strongest = strongest_of({candidate(1.0, 0.5, 3), candidate(1.1, 0.5, 2)}, 0.5);
  ASSERT_EQ(strongest.size(), 1U);
  EXPECT_EQ(strongest[0].best.index, 2U);
}

TEST(PeaksOf, AreAboveTheThresholdAndNoLowerThanTheirNeighbours) {
  cv::Mat degrees = cv::Mat::zeros(4, 6, CV_32F);
  degrees.at<float>(1, 1) = 0.8F;
  degrees.at<float>(1, 2) = 0.7F;
  degrees.at<float>(3, 5) = 0.6F;
  degrees.at<float>(0, 5) = 0.2F;
  EXPECT_THAT(peaks_of(degrees, {10, 20}, 0.5), testing::ElementsAre(Cell{11, 21}, Cell{15, 23}));
}

template <class Made, class Config>
std::unique_ptr<Detector> made() {
  Config config;
  return std::make_unique<Made>(config, templates());
}

using Maker = std::unique_ptr<Detector> (*)();
class OpenCvDetector : public testing::TestWithParam<std::pair<const char*, Maker>> {};

INSTANTIATE_TEST_SUITE_P(
    All, OpenCvDetector,
    testing::Values(std::pair<const char*, Maker>{"match_template", made<MatchTemplate, MatchTemplateConfig>},
                    std::pair<const char*, Maker>{"chamfer", made<Chamfer, ChamferConfig>},
                    std::pair<const char*, Maker>{"generalized_hough", made<GeneralizedHough, HoughConfig>}),
    [](const auto& maker) { return maker.param.first; });

TEST_P(OpenCvDetector, ReportsWhatStandsWhereAndHowItIsTurned) {
  const Pose2 square{1.025, 1.525, radians(30.0)};
  const Pose2 triangle{3.525, 1.525, radians(75.0)};
  const OccupancyGrid grid = grid_with({{1, square}, {2, triangle}});
  const auto detector = GetParam().second();
  std::vector<Detection> found = found_by(*detector, grid, grid.bounds());
  ASSERT_GE(found.size(), 2U);
  std::sort(found.begin(), found.begin() + 2,
            [](const Detection& a, const Detection& b) { return a.category < b.category; });
  EXPECT_EQ(found[0].category, "square");
  EXPECT_LT((found[0].T_map_landmark.position() - square.position()).norm(), 0.08);
  EXPECT_NEAR(found[0].T_map_landmark.theta_rad, square.theta_rad, 1e-9);
  EXPECT_EQ(found[1].category, "triangle");
  EXPECT_LT((found[1].T_map_landmark.position() - triangle.position()).norm(), 0.08);
  EXPECT_NEAR(found[1].T_map_landmark.theta_rad, triangle.theta_rad, 1e-9);
  ASSERT_FALSE(found[0].templates.empty());
  EXPECT_EQ(found[0].templates[0].category, "square");
  EXPECT_DOUBLE_EQ(found[0].templates[0].degree, found[0].degree);
}

TEST_P(OpenCvDetector, LooksOnlyWhereSomethingHasChanged) {
  const Pose2 square{1.025, 1.525, 0.0};
  const Pose2 circle{3.525, 1.525, 0.0};
  const OccupancyGrid grid = grid_with({{1, square}, {0, circle}});
  const auto detector = GetParam().second();
  for (const Detection& found : found_by(*detector, grid, {{68, 28}, {72, 32}}))
    EXPECT_GT(found.T_map_landmark.x_m, 2.5) << "the square is too far away to look different";
  const std::vector<Detection> found = found_by(*detector, grid, {{60, 20}, {80, 40}});
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].category, "circle");
}

TEST_P(OpenCvDetector, WhatABudgetCutOffIsSearchedWithTheNextChange) {
  const Pose2 square{1.025, 1.525, 0.0};
  const OccupancyGrid grid = grid_with({{1, square}});
  const auto detector = GetParam().second();
  Budget none;
  none.iterations = 0;
  EXPECT_TRUE(detector->detect(grid, everything_in(grid.bounds()), none).matchings.empty());
  const std::vector<Detection> found = found_by(*detector, grid, {{98, 58}, {99, 59}});
  ASSERT_FALSE(found.empty());
  EXPECT_LT((found[0].T_map_landmark.position() - square.position()).norm(), 0.15);
}

TEST_P(OpenCvDetector, NeedsTheCellsOfItsTemplates) {
  const auto detector = GetParam().second();
  const OccupancyGrid coarse(0.1);
  EXPECT_THROW((void)detector->detect(coarse, {}, Budget{}), std::invalid_argument);
}

TEST(Chamfer, WithoutAnEdgeInATemplateTheThresholdIsToBlame) {
  ChamferConfig config;
  config.edge_low = config.edge_high = 1140.0;
  try {
    const Chamfer detector(config, templates());
    FAIL() << "no template is that steep";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("has no edge above edge_high"));
  }
}

// The grid is clamped short of certainty, and a mask leaves out the ground round about.
TEST(MatchTemplate, AClearLandmarkFitsWellInEveryPicture) {
  const OccupancyGrid grid = grid_with({{1, {1.025, 1.525, 0.0}}});
  for (const auto& [picture, masked, least] : {std::tuple{Picture::gradients, true, 0.97},
                                               {Picture::magnitude, true, 0.85},
                                               {Picture::occupancy, false, 0.97}}) {
    MatchTemplateConfig config;
    config.picture = picture;
    config.masked = masked;
    config.tau_match = 0.1;
    MatchTemplate detector(config, templates());
    const std::vector<Detection> found = found_by(detector, grid, grid.bounds());
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0].category, "square");
    EXPECT_GT(found[0].degree, least);
  }
}

}  // namespace
}  // namespace cairn::opencv_detectors
