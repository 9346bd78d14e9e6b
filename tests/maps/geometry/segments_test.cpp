#include "maps/geometry/segments.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace cairn {
namespace {

const std::vector<Point> kL{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

TEST(Segments, TheNearestPointIsOnTheSegment) {
  EXPECT_EQ(nearest_on_segment({1, 5}, {0, 0}, {2, 0}), Point(1, 0));
  EXPECT_EQ(nearest_on_segment({-1, 5}, {0, 0}, {2, 0}), Point(0, 0));
  EXPECT_EQ(distance_to_segment_m({5, 4}, {0, 0}, {2, 0}), 5.0);
  EXPECT_EQ(share_along({0.5, 1}, {0, 0}, {2, 0}), 0.25);
}

TEST(Segments, ASegmentMayBeAPoint) {
  EXPECT_EQ(distance_to_segment_m({3, 4}, {0, 0}, {0, 0}), 5.0);
}

TEST(Segments, NoPointOfTheSegmentIsNearer) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> at(-2.0, 2.0);
  for (int i = 0; i < 1000; ++i) {
    const Point p(at(random), at(random));
    const Point a(at(random), at(random));
    const Point b(at(random), at(random));
    const double distance_m = distance_to_segment_m(p, a, b);
    double nearest_m = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 100; ++k) nearest_m = std::min(nearest_m, (a + k / 100.0 * (b - a) - p).norm());
    EXPECT_LE(distance_m, nearest_m + 1e-12);
    EXPECT_GE(distance_m, nearest_m - 0.01 * (b - a).norm());
  }
}

TEST(Segments, LengthsOfPathsAreThoseOfTheirPieces) {
  EXPECT_EQ(length_of(std::vector<Point>{}), 0.0);
  EXPECT_EQ(length_of(std::vector<Point>{{0, 0}, {3, 4}, {3, 5}}), 6.0);
  EXPECT_EQ(length_of(std::vector<Pose2>{{0, 0, 1}, {3, 4, 2}, {3, 5, 3}}), 6.0);
}

TEST(Segments, APolygonHoldsWhatIsInsideWhicheverWayItRuns) {
  const std::vector<Point> clockwise(kL.rbegin(), kL.rend());
  for (const auto& polygon : {kL, clockwise}) {
    EXPECT_TRUE(is_inside(polygon, {0.5, 1.5}));
    EXPECT_TRUE(is_inside(polygon, {1.5, 0.5}));
    EXPECT_FALSE(is_inside(polygon, {1.5, 1.5}));
    EXPECT_FALSE(is_inside(polygon, {-0.1, 0.5}));
    EXPECT_DOUBLE_EQ(distance_to_outline_m(polygon, {1.5, 1.5}), 0.5);
    EXPECT_DOUBLE_EQ(distance_to_outline_m(polygon, {0.5, 0.25}), 0.25);
  }
}

TEST(Segments, APoseIsFiniteWhenAllItsNumbersAre) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_finite({1, 2, 3}));
  for (const Pose2& pose : {Pose2{nan, 0, 0}, Pose2{0, std::numeric_limits<double>::infinity(), 0}, Pose2{0, 0, nan}})
    EXPECT_FALSE(is_finite(pose));
}

TEST(SegmentDistance, IsToTheNearestPlaceOfTheSegment) {
  EXPECT_DOUBLE_EQ(distance_to_segment_m({1, 1}, {0, 0}, {2, 0}), 1.0);
  EXPECT_DOUBLE_EQ(distance_to_segment_m({5, 4}, {0, 0}, {2, 0}), 5.0);
  EXPECT_DOUBLE_EQ(distance_to_segment_m({3, 4}, {0, 0}, {0, 0}), 5.0) << "a point";
}

}  // namespace
}  // namespace cairn
