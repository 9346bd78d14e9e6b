#include "maps/landmarks/landmark_template.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "maps/landmarks/ring_template.hpp"

namespace cairn {
namespace {

constexpr double kCellM = 0.05;

Contour square(double side_m) {
  const double h = side_m / 2.0;
  return Contour::polygon({{-h, -h}, {h, -h}, {h, h}, {-h, h}});
}

Contour regular(int corners, double radius_m) {
  std::vector<Point> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    points.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle));
  }
  return Contour::polygon(points);
}

Contour rectangle(double width_m, double height_m) {
  return Contour::polygon({{0, 0}, {width_m, 0}, {width_m, height_m}, {0, height_m}});
}

std::size_t orientations(const Contour& contour, double step_deg, double cell_m = kCellM) {
  return distinct_orientations(contour, radians(step_deg), cell_m).size();
}

// '.' no edge cell, otherwise where the gradient mostly points.
std::vector<std::string> drawing_of(const LandmarkTemplate& t, int reach) {
  std::vector<std::string> rows(static_cast<std::size_t>(2 * reach + 1), std::string(2 * reach + 1, '.'));
  for (const TemplateCell& cell : t.cells) {
    const bool is_sideways = std::abs(cell.gradient_x) >= std::abs(cell.gradient_y);
    const char mark = is_sideways ? (cell.gradient_x > 0 ? '>' : '<') : (cell.gradient_y > 0 ? '^' : 'v');
    rows[static_cast<std::size_t>(reach - cell.offset.y)][static_cast<std::size_t>(reach + cell.offset.x)] = mark;
  }
  return rows;
}

TEST(DistinctOrientations, CountsTheSymmetriesOfTheUsualShapesAt15Degrees) {
  EXPECT_EQ(orientations(Contour::circle(0.5), 15.0), 1U);
  EXPECT_EQ(orientations(square(0.5), 15.0), 6U);
  EXPECT_EQ(orientations(square(0.6), 15.0), 6U);
  EXPECT_EQ(orientations(regular(3, 0.35), 15.0), 8U);
  EXPECT_EQ(orientations(rectangle(0.8, 0.4), 15.0), 12U);
}

TEST(DistinctOrientations, CountsTheSymmetriesOfTheUsualShapesAt5Degrees) {
  EXPECT_EQ(orientations(Contour::circle(0.5), 5.0), 1U);
  EXPECT_EQ(orientations(square(0.55), 5.0), 18U);
  EXPECT_EQ(orientations(regular(3, 0.35), 5.0), 24U);
  EXPECT_EQ(orientations(rectangle(0.8, 0.4), 5.0), 36U);
}

TEST(DistinctOrientations, OfAShapeWithoutSymmetryFillTheTurn) {
  EXPECT_EQ(orientations(Contour::polygon({{0, 0}, {0.9, 0}, {0.2, 0.4}}), 15.0), 24U);
}

TEST(DistinctOrientations, AreNotCutShortWhereCoarseCellsHideAStep) {
  // At 0.1 m a step of 1 degree often changes nothing; the square must still cover its quarter turn.
  const std::vector<double> found = distinct_orientations(square(0.6), radians(1.0), 0.1);
  ASSERT_GT(found.size(), 10U);
  EXPECT_LT(found.size(), 90U);
  EXPECT_GT(found.back(), radians(70.0));
}

TEST(DistinctOrientations, StartAtZeroAndRise) {
  const std::vector<double> found = distinct_orientations(square(0.5), radians(15.0), kCellM);
  ASSERT_EQ(found.size(), 6U);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(degrees(found[i]), 15.0 * static_cast<double>(i), 1e-9);
}

TEST(DistinctOrientations, RefuseAStepOfZero) {
  EXPECT_THROW((void)distinct_orientations(square(0.5), 0.0, kCellM), std::invalid_argument);
  EXPECT_THROW((void)distinct_orientations(square(0.5), 0.1, -kCellM), std::invalid_argument);
}

TEST(IdealRendering, OfASquareLooksOutwardInFromEverySide) {
  const LandmarkTemplate t = render_ideal({"square", square(0.35)}, 0.0, kCellM);
  EXPECT_EQ(t.category, "square");
  EXPECT_THAT(drawing_of(t, 5), ::testing::ElementsAre("..vvvvvvv..",  //
                                                       ".>vvvvvvv<.",  //
                                                       ">>.......<<",  //
                                                       ">>.......<<",  //
                                                       ">>.......<<",  //
                                                       ">>.......<<",  //
                                                       ">>.......<<",  //
                                                       ">>.......<<",  //
                                                       ">>.......<<",  //
                                                       ".>^^^^^^^<.",  //
                                                       "..^^^^^^^.."));
}

TEST(IdealRendering, HasStrongGradientsOnStraightSides) {
  const LandmarkTemplate t = render_ideal({"square", square(0.6)}, 0.0, kCellM);
  const auto right_side = std::find_if(t.cells.begin(), t.cells.end(), [](const TemplateCell& c) {
    return c.offset == Cell{7, 0};
  });
  ASSERT_NE(right_side, t.cells.end());
  EXPECT_EQ(right_side->gradient_x, -1020);
  EXPECT_EQ(right_side->gradient_y, 0);
}

TEST(IdealRendering, SortsItsCellsByRowThenColumn) {
  const LandmarkTemplate t = render_ideal({"triangle", regular(3, 0.35)}, radians(30.0), kCellM);
  EXPECT_TRUE(std::is_sorted(t.cells.begin(), t.cells.end(), [](const TemplateCell& a, const TemplateCell& b) {
    return std::pair(a.offset.y, a.offset.x) < std::pair(b.offset.y, b.offset.x);
  }));
}

TEST(IdealRendering, OfASquareRepeatsToTheBitAfterAQuarterTurn) {
  for (const double side_m : {0.4, 0.5, 0.55, 0.6}) {
    const LandmarkShape shape{"square", square(side_m)};
    EXPECT_EQ(render_ideal(shape, 0.0, kCellM).cells, render_ideal(shape, radians(90.0), kCellM).cells) << side_m;
    EXPECT_EQ(render_ideal(shape, radians(15.0), kCellM).cells, render_ideal(shape, radians(105.0), kCellM).cells)
        << side_m;
  }
}

TEST(RingRendering, OfACircleIsTheRingOfALargerCircle) {
  for (const double offset_m : {-0.05, 0.0, 0.03, 0.1}) {
    const LandmarkTemplate moved = render_ring({"circle", Contour::circle(0.5)}, 0.0, kCellM, offset_m);
    const LandmarkTemplate larger = render_ideal({"circle", Contour::circle(0.5 + 2.0 * offset_m)}, 0.0, kCellM);
    EXPECT_EQ(moved.cells, larger.cells) << offset_m;
  }
}

TEST(RingRendering, OnTheOutlineIsTheIdealOne) {
  const LandmarkShape shape{"square", square(0.5)};
  EXPECT_EQ(render_ring(shape, radians(15.0), kCellM, 0.0).cells, render_ideal(shape, radians(15.0), kCellM).cells);
}

TEST(RingRendering, RefusesARingThatHasNoCell) {
  try {
    (void)render_ring({"disc", Contour::circle(0.1)}, 0.0, 0.02, -0.2);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "a ring drawn -0.2 m outside the outline of the disc has no cell");
  }
}

TEST(IdealSet, HoldsFifteenTemplatesForThePapersThreeCategories) {
  const TemplateSet set =
      render_ideal_set({{"circle", Contour::circle(0.5)}, {"square", square(0.5)}, {"triangle", regular(3, 0.35)}},
                       radians(15.0), kCellM);
  EXPECT_EQ(set.templates.size(), 15U);
  EXPECT_EQ(set.templates.front().category, "circle");
  EXPECT_EQ(set.templates.back().category, "triangle");
  EXPECT_NEAR(degrees(set.templates.back().orientation_rad), 105.0, 1e-9);
  EXPECT_NEAR(set.smallest_diameter_m(), 0.5, 1e-12);
  EXPECT_NEAR(set.largest_diameter_m(), 0.5 * std::sqrt(2.0), 1e-12);
}

}  // namespace
}  // namespace cairn
