#include "maps/landmarks/close_categories.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

// A square whose last matching there had these degrees; 0: that category did not fit.
Landmark square(double square, double circle, double triangle = 0.0) {
  Landmark landmark;
  landmark.category = "square";
  landmark.degree = 0.74;
  landmark.evidence = {
      {"circle", 3, 0.6, 0.9, circle}, {"square", 5, 0.6, 0.74, square}, {"triangle", 1, 0.5, 0.5, triangle}};
  return landmark;
}

TEST(CloseCategories, AreThoseOfTheLastMatchingWhoseDegreesAreNearlyTheSame) {
  EXPECT_EQ(close_categories(square(0.71, 0.69, 0.4)), (CloseCategories{"square", "circle", 0.71, 0.69}));
  EXPECT_EQ(close_categories(square(0.71, 0.4, 0.7)), (CloseCategories{"square", "triangle", 0.71, 0.7}));
  EXPECT_EQ(close_text(square(0.71, 0.69)), "square 0.71, circle 0.69");
  EXPECT_EQ(degree_text(square(0.71, 0.69)), "0.74, close: square 0.71, circle 0.69");
}

TEST(CloseCategories, AnotherThatWasBetterWithoutBeingSureIsCloseToo) {
  EXPECT_EQ(close_categories(square(0.66, 0.69)), (CloseCategories{"square", "circle", 0.66, 0.69}));
}

TEST(CloseCategories, AreNoneWhereTheCategoryIsClear) {
  EXPECT_EQ(close_categories(square(0.71, 0.6)), std::nullopt);
  EXPECT_EQ(close_categories(square(0.71, 0.0)), std::nullopt) << "what did not fit in the last matching";
  EXPECT_EQ(close_categories(Landmark{}), std::nullopt) << "an imported place";
  EXPECT_EQ(degree_text(square(0.71, 0.6)), "0.74");
  EXPECT_EQ(close_text(square(0.71, 0.6)), "");
}

}  // namespace
}  // namespace cairn
