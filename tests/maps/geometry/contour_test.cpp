#include "maps/geometry/contour.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace cairn {
namespace {

using ::testing::HasSubstr;

std::vector<Point> box(double min_x, double min_y, double max_x, double max_y) {
  return {{min_x, min_y}, {max_x, min_y}, {max_x, max_y}, {min_x, max_y}};
}

std::string error_of(const std::vector<Point>& corners) {
  try {
    (void)Contour::polygon(corners);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

double signed_area(const std::vector<Point>& p) {
  double twice = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point& a = p[i];
    const Point& b = p[(i + 1) % p.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return twice / 2.0;
}

TEST(Contour, MeasuresACircleFromItsRim) {
  const Contour circle = Contour::circle(0.6);
  EXPECT_TRUE(circle.is_circle());
  EXPECT_DOUBLE_EQ(circle.signed_distance({0.0, 0.0}), -0.3);
  EXPECT_DOUBLE_EQ(circle.signed_distance({0.0, 0.5}), 0.2);
  EXPECT_DOUBLE_EQ(circle.inner_diameter_m(), 0.6);
  EXPECT_DOUBLE_EQ(circle.outer_diameter_m(), 0.6);
}

TEST(Contour, MeasuresASquareFromSidesAndCorners) {
  const Contour square = Contour::polygon(box(-0.3, -0.3, 0.3, 0.3));
  EXPECT_NEAR(square.signed_distance({0.0, 0.0}), -0.3, 1e-12);
  EXPECT_NEAR(square.signed_distance({0.5, 0.1}), 0.2, 1e-12);
  EXPECT_NEAR(square.signed_distance({0.6, 0.7}), 0.5, 1e-12);
  EXPECT_NEAR(square.inner_diameter_m(), 0.6, 1e-12);
  EXPECT_NEAR(square.outer_diameter_m(), 0.6 * std::sqrt(2.0), 1e-12);
}

TEST(Contour, PutsTheOriginAtTheCentroidOfTheAreaNotOfTheCorners) {
  // An L of three unit squares with an extra corner on one side: centroid of the area (5/6, 5/6).
  const Contour ell = Contour::polygon({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  const Point corner = ell.polygons_m[0].front();
  EXPECT_NEAR(corner.x(), -5.0 / 6.0, 1e-12);
  EXPECT_NEAR(corner.y(), -5.0 / 6.0, 1e-12);
}

TEST(Contour, KeepsTheFrameOfAPolygonInPlace) {
  const Contour room = Contour::polygon_in_place(box(3.0, 1.0, 5.0, 2.0));
  EXPECT_EQ(room.polygons_m[0].front(), Point(3.0, 1.0));
  EXPECT_DOUBLE_EQ(room.inner_diameter_m(), 0.0);
  EXPECT_NEAR(room.signed_distance({4.0, 1.5}), -0.5, 1e-12);
}

TEST(Contour, TurnsClockwiseCornersRound) {
  const Contour triangle = Contour::polygon({{0, 0}, {0, 1}, {1, 0}});
  EXPECT_GT(signed_area(triangle.polygons_m.front()), 0.0);
}

TEST(Contour, IsConcaveInsideTheNotch) {
  const Contour notch = Contour::polygon_in_place({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}});
  EXPECT_GT(notch.signed_distance({2.0, 2.0}), 0.0);
  EXPECT_LT(notch.signed_distance({2.0, 0.5}), 0.0);
}

TEST(Contour, SignedDistanceChangesNoFasterThanThePointMoves) {
  const Contour star = Contour::polygon({{0, 0}, {3, 1}, {6, 0}, {5, 3}, {6, 6}, {3, 5}, {0, 6}, {1, 3}});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> metres(-5.0, 5.0);
  for (int i = 0; i < 2000; ++i) {
    const Point a(metres(random), metres(random));
    const Point b(metres(random), metres(random));
    EXPECT_LE(std::abs(star.signed_distance(a) - star.signed_distance(b)), (a - b).norm() + 1e-12);
  }
}

TEST(Contour, RefusesACircleWithoutSize) {
  EXPECT_THROW((void)Contour::circle(0.0), std::invalid_argument);
  EXPECT_THROW((void)Contour::circle(-1.0), std::invalid_argument);
  EXPECT_THROW((void)Contour::circle(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

TEST(Contour, SaysWhatIsWrongWithAPolygon) {
  EXPECT_THAT(error_of({{0, 0}, {1, 0}}), HasSubstr("at least 3 corners, this one has 2"));
  EXPECT_THAT(error_of({{0, 0}, {1, 1}, {2, 2}}), HasSubstr("no area"));
  EXPECT_THAT(error_of({{0, 0}, {1, std::numeric_limits<double>::infinity()}, {2, 2}}),
              HasSubstr("corner 1 of the polygon is not finite"));
  EXPECT_THAT(error_of({{0, 0}, {1, 0}, {0, 1}, {0, 0}}), HasSubstr("corner 0 of the polygon repeats corner 3"));
  EXPECT_THAT(error_of({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), HasSubstr("crosses itself"));
  EXPECT_THAT(error_of({{0, 0}, {2, 0}, {1, 0}, {1, 1}}), HasSubstr("folds back on itself"));
}

std::string error_of_parts(const std::vector<std::vector<Point>>& polygons) {
  try {
    (void)Contour::parts(polygons);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(Contour, OfSeveralPartsHasItsOriginAtTheirCommonCentroid) {
  // A post of one square metre at x = 0.5 and one of three at x = 4.5, drawn clockwise.
  const Contour posts = Contour::parts({box(0, 0, 1, 1), {{4, -1}, {4, 2}, {5, 2}, {5, -1}}});
  EXPECT_NEAR(posts.polygons_m[0][0].x(), -(0.5 + 3 * 4.5) / 4.0, 1e-12);
  EXPECT_NEAR(posts.polygons_m[0][0].y(), -0.5, 1e-12);
  EXPECT_GT(signed_area(posts.polygons_m[1]), 0.0);
  EXPECT_NEAR(posts.outer_diameter_m(), 2.0 * std::hypot(3.5, 0.5), 1e-12);
  EXPECT_EQ(posts.inner_diameter_m(), 0.0) << "the centre is between the posts";
}

TEST(Contour, OfSeveralPartsMeasuresToTheNearest) {
  const Contour posts = Contour::parts_in_place({box(0, 0, 1, 1), box(3, 0, 4, 1)});
  EXPECT_NEAR(posts.signed_distance({0.5, 0.75}), -0.25, 1e-12);
  EXPECT_NEAR(posts.signed_distance({3.75, 0.5}), -0.25, 1e-12);
  EXPECT_NEAR(posts.signed_distance({2.5, 0.5}), 0.5, 1e-12);
}

TEST(Contour, SaysWhatIsWrongWithParts) {
  EXPECT_THAT(error_of_parts({}), HasSubstr("at least one part"));
  EXPECT_THAT(error_of_parts({box(0, 0, 1, 1), box(0.5, 0.5, 2, 2)}), HasSubstr("part 2 meets part 1"));
  EXPECT_THAT(error_of_parts({box(0, 0, 1, 1), box(1, 0, 2, 1)}), HasSubstr("part 2 meets part 1"));
  EXPECT_THAT(error_of_parts({box(5, 5, 6, 6), box(0, 0, 1, 1), box(-1, -1, 2, 2)}), HasSubstr("part 3 meets part 2"));
  EXPECT_THAT(error_of_parts({box(0, 0, 1, 1), {{2, 2}, {3, 3}}}), HasSubstr("part 2: a polygon needs at least 3"));
}

TEST(Contour, DrawsACircleAsAPolygonWhenAsked) {
  const std::vector<std::vector<Point>> outlines = Contour::circle(2.0).outlines_m(4);
  ASSERT_EQ(outlines.size(), 1U);
  ASSERT_EQ(outlines[0].size(), 4U);
  EXPECT_NEAR((outlines[0][1] - Point(0.0, 1.0)).norm(), 0.0, 1e-12);
}

TEST(Contour, RefusesAPolygonThatTouchesItself) {
  EXPECT_THAT(error_of({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}), HasSubstr("crosses itself"));
}

}  // namespace
}  // namespace cairn
