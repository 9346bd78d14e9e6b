#include "plugins/template_matcher/refine.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/plugins/template_matcher/drawn_grid.hpp"

namespace cairn::template_matcher {
namespace {

TEST(ParabolaMinimum, FindsTheBottom) {
  const auto parabola = [](double x) { return 3.0 * (x - 0.25) * (x - 0.25) + 7.0; };
  const Minimum minimum = parabola_minimum(parabola(-1), parabola(0), parabola(1));
  EXPECT_NEAR(minimum.at, 0.25, 1e-12);
  EXPECT_NEAR(minimum.value, parabola(minimum.at), 1e-12);
}

TEST(ParabolaMinimum, StaysWithinHalfAStepAndIs0WithoutACurve) {
  EXPECT_EQ(parabola_minimum(9.0, 5.0, 4.0).at, 0.5);
  EXPECT_EQ(parabola_minimum(4.0, 5.0, 9.0).at, -0.5);
  EXPECT_EQ(parabola_minimum(1.0, 1.0, 1.0).value, 1.0);
  EXPECT_EQ(parabola_minimum(1.0, 2.0, 1.0).at, 0.0);
}

TEST(PlaceInCell, PointsTowardsTheLandmarkBetweenCells) {
  const LandmarkTemplate shape = render_ideal(circle_shape(), 0.0, 0.05);
  OccupancyGrid grid(0.05);
  const Point centre = grid.centre_of({0, 0});
  paint(grid, circle_shape().contour, {centre.x() + 0.02, centre.y() - 0.02, 0.0}, {{-20, -20}, {20, 20}});
  const GradientField field(grid, {{-12, -12}, {13, 13}});
  const auto [offset, mismatch] = place_in_cell(field, shape, {0, 0});
  EXPECT_LT(mismatch, mismatch_at(field, shape, {0, 0}));
  EXPECT_GT(offset.x(), 0.05);
  EXPECT_LT(offset.y(), -0.05);
  EXPECT_LE(std::abs(offset.x()), 0.5);
  EXPECT_LE(std::abs(offset.y()), 0.5);
}

// One family of `count` templates 15 degrees apart, `ranks` templates an orientation.
TemplateSet family(std::size_t count, std::size_t ranks) {
  TemplateSet set;
  set.step_rad = radians(15.0);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t r = 0; r < ranks; ++r) {
      set.templates.push_back({"square", static_cast<double>(k) * set.step_rad, std::vector<TemplateCell>(10)});
    }
  }
  return set;
}

std::vector<TemplateMatch> matches_with(std::vector<std::int32_t> mismatches) {
  std::vector<TemplateMatch> matches;
  for (const std::int32_t m : mismatches) matches.push_back({{0, 0}, m});
  return matches;
}

TEST(OrientationNeighbours, LeanTowardsTheBetterOne) {
  const TemplateSet set = family(6, 1);
  const OrientationNeighbours neighbours(set);
  const auto matches = matches_with({900, 900, 500, 300, 400, 900});
  EXPECT_NEAR(neighbours.offset_rad(3, matches, set.templates), radians(15.0) * 0.5 * 100.0 / 300.0, 1e-12);
}

TEST(OrientationNeighbours, CloseOverThePeriodOfASymmetry) {
  const TemplateSet set = family(6, 1);  // 90 degrees
  const OrientationNeighbours neighbours(set);
  const auto matches = matches_with({300, 500, 900, 900, 900, 400});
  EXPECT_LT(neighbours.offset_rad(0, matches, set.templates), 0.0);
}

TEST(OrientationNeighbours, DoNotCloseOverWhatIsNoSymmetry) {
  const TemplateSet set = family(5, 1);  // 75 degrees do not divide the turn
  const OrientationNeighbours neighbours(set);
  const auto matches = matches_with({300, 500, 900, 900, 400});
  EXPECT_EQ(neighbours.offset_rad(0, matches, set.templates), 0.0);
}

TEST(OrientationNeighbours, AreOfTheSameRankWhereAnOrientationHasSeveralTemplates) {
  const TemplateSet set = family(6, 2);
  const OrientationNeighbours neighbours(set);
  //                                0         15        30        45        60        75
  const auto matches = matches_with({900, 1, 900, 1, 500, 1, 300, 1, 500, 1, 900, 1});
  EXPECT_EQ(neighbours.offset_rad(6, matches, set.templates), 0.0);
}

TEST(OrientationNeighbours, OfACircleDoNotExist) {
  const TemplateSet set = family(1, 1);
  EXPECT_EQ(OrientationNeighbours(set).offset_rad(0, matches_with({300}), set.templates), 0.0);
}

TEST(OrientationNeighbours, AreLeftAloneWhereStepsAreMissing) {
  TemplateSet set = family(6, 1);
  set.templates.erase(set.templates.begin() + 2);
  const auto matches = matches_with({900, 500, 300, 400, 900});
  EXPECT_EQ(OrientationNeighbours(set).offset_rad(2, matches, set.templates), 0.0);
}

}  // namespace
}  // namespace cairn::template_matcher
