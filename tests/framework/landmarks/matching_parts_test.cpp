#include "framework/landmarks/matching_parts.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

Matching square_beside_circle() {
  Matching matching;
  matching.degrees = {{"circle", 0.7, 0.0, {1.3, 0.0}},
                      {"square", 0.8, 0.1, {1.0, 0.0}},
                      {"triangle", 0.62, 0.2, {1.1, 0.0}},
                      {"star", 0.4, 0.0, {1.0, 0.0}, false}};
  matching.detection = Detection{
      "square", {1.01, 0.0, 0.12}, 0.8, {{"square", 0.1, 0.8}, {"circle", 0.0, 0.7}, {"triangle", 0.2, 0.62}}};
  return matching;
}

TEST(MatchingParts, DegreesFarApartAreOfTwoPlacesAndTheDetectionStandsInItsOwn) {
  const std::vector<Matching> parts = parts_of(square_beside_circle(), 0.2);
  ASSERT_EQ(parts.size(), 2U);
  ASSERT_TRUE(parts[0].detection);
  EXPECT_DOUBLE_EQ(place_of(parts[0]).x(), 1.01) << "between the cells";
  ASSERT_EQ(parts[0].degrees.size(), 2U) << "what does not fit is left out";
  EXPECT_EQ(parts[0].degrees[0].category, "square");
  EXPECT_EQ(parts[0].degrees[1].category, "triangle");
  EXPECT_FALSE(parts[1].detection);
  EXPECT_DOUBLE_EQ(place_of(parts[1]).x(), 1.3);
}

TEST(MatchingParts, TemplatesGoWithTheirCategory) {
  const std::vector<Matching> parts = parts_of(square_beside_circle(), 0.2);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].detection->templates,
            (std::vector<TemplateDegree>{{"square", 0.1, 0.8}, {"triangle", 0.2, 0.62}}));
  EXPECT_EQ(parts[0].templates, parts[0].detection->templates);
  EXPECT_EQ(parts[1].templates, (std::vector<TemplateDegree>{{"circle", 0.0, 0.7}}));
}

TEST(MatchingParts, ADetectionWithoutDegreesIsAPart) {
  Matching matching;
  matching.detection = Detection{"square", {1.0, 2.0, 0.5}, 0.7, {}};
  const std::vector<Matching> parts = parts_of(matching, 0.2);
  ASSERT_EQ(parts.size(), 1U);
  ASSERT_EQ(parts[0].degrees.size(), 1U);
  EXPECT_EQ(parts[0].degrees[0].category, "square");
  EXPECT_DOUBLE_EQ(parts[0].degrees[0].degree, 0.7);
}

TEST(MatchingParts, AMatchingThatFitsNothingHasNone) {
  EXPECT_TRUE(parts_of({}, 0.2).empty());
}

}  // namespace
}  // namespace cairn
