#include "plugins/template_matcher/classify.hpp"

#include <gmock/gmock.h>

namespace cairn::template_matcher {
namespace {

constexpr double kMu = 100.0;

LandmarkTemplate shape_of(const std::string& category, double angle_deg, std::size_t cells) {
  return {category, radians(angle_deg), std::vector<TemplateCell>(cells)};
}

// The mismatch that gives a template of so many cells this degree.
TemplateMatch match_of(double degree, std::size_t cells, Cell at = {0, 0}) {
  return {at,
          static_cast<std::int32_t>(std::lround((1.0 - degree) * kMu * kMismatchPerUnit * static_cast<double>(cells)))};
}

const std::vector<LandmarkTemplate> kTemplates = {shape_of("circle", 0, 10), shape_of("square", 0, 20),
                                                  shape_of("square", 15, 30), shape_of("triangle", 0, 40)};

std::vector<TemplateMatch> matches_of(double circle, double square0, double square15, double triangle) {
  return {match_of(circle, 10, {1, 1}), match_of(square0, 20, {2, 2}), match_of(square15, 30, {3, 3}),
          match_of(triangle, 40, {4, 4})};
}

TEST(Degree, FallsFrom1To0WithTheMeanMismatch) {
  EXPECT_DOUBLE_EQ(degree_of(0, 10, kMu), 1.0);
  EXPECT_DOUBLE_EQ(degree_of(10 * 50 * kMismatchPerUnit, 10, kMu), 0.5);
  EXPECT_DOUBLE_EQ(degree_of(10 * 150 * kMismatchPerUnit, 10, kMu), 0.0);
}

TEST(MismatchCeiling, IsTheLeastMismatchWithNoMoreThanTheDegree) {
  for (const double degree : {0.0, 0.1, 0.53, 0.55, 1.0 / 3.0, 0.999999}) {
    for (const std::size_t cells : {1U, 7U, 118U, 999U}) {
      const std::int32_t ceiling = mismatch_ceiling(degree, cells, 1140.39);
      EXPECT_LE(degree_of(ceiling, cells, 1140.39), degree);
      EXPECT_GT(degree_of(ceiling - 1, cells, 1140.39), degree);
    }
  }
  EXPECT_EQ(mismatch_ceiling(1.0, 10, kMu), 0);
}

TEST(Classify, LeavesOutCategoriesWithoutAMatch) {
  TemplateSet set;
  set.shapes = {{"circle", {}}, {"square", {}}, {"triangle", {}}};
  set.templates = kTemplates;
  auto matches = matches_of(0.5, 0.7, 0.8, 0.6);
  matches[0] = {};
  matches[2] = {};
  const auto degrees = degrees_by_category(matches, set, OccupancyGrid(0.05), {kMu, 0.6, 0.0, 0.0});
  ASSERT_EQ(degrees.size(), 2U);
  EXPECT_EQ(degrees[0].category, "square");
  EXPECT_NEAR(degrees[0].degree, 0.7, 1e-3);
  EXPECT_TRUE(is_decided(1, matches, kTemplates, {kMu, 0.6, 0.0, 0.0}));
}

TEST(Classify, TakesTheBestTemplateOfAll) {
  const auto matches = matches_of(0.5, 0.7, 0.8, 0.6);
  EXPECT_EQ(best_template(matches, kTemplates), 2U);
  EXPECT_TRUE(is_decided(2, matches, kTemplates, {kMu, 0.6, 0.0, 0.0}));
}

TEST(Classify, NeedsMoreThanTauMatch) {
  const auto matches = matches_of(0.2, 0.3, 0.6, 0.1);
  EXPECT_FALSE(is_decided(2, matches, kTemplates, {kMu, 0.6, 0.0, 0.0}));
  EXPECT_TRUE(is_decided(2, matches, kTemplates, {kMu, 0.59, 0.0, 0.0}));
}

TEST(Classify, ATolerantTemplateFitsWithSoManyTimesTheMismatch) {
  std::vector<LandmarkTemplate> templates = kTemplates;
  const ScoreRule rule{kMu, 0.6, 0.0, 0.0};
  const auto matches = matches_of(0.3, 0.55, 0.3, 0.3);
  EXPECT_FALSE(is_decided(1, matches, templates, rule));
  templates[1].tolerance = 1.2;
  EXPECT_EQ(best_template(matches, templates), 1U);
  EXPECT_TRUE(is_decided(1, matches, templates, rule));
  EXPECT_NEAR(templates_above(matches, templates, rule).front().degree, 1.0 - 0.45 / 1.2, 1e-3);
  EXPECT_FALSE(fits_better(matches[1], kTemplates[1], match_of(0.6, 40), kTemplates[3]));
  EXPECT_TRUE(fits_better(matches[1], templates[1], match_of(0.6, 40), kTemplates[3]));
}

TEST(Classify, ToleranceDoesNotBeatWhatFitsWithout) {
  std::vector<LandmarkTemplate> templates = kTemplates;
  templates[1].tolerance = 1.2;
  const ScoreRule rule{kMu, 0.6, 0.0, 0.0};
  auto matches = matches_of(0.64, 0.59, 0.3, 0.3);
  ASSERT_EQ(best_template(matches, templates), 1U) << "0.66 with its tolerance";
  ASSERT_TRUE(fits_without_tolerance(matches, templates, rule));
  take_tolerance(matches, templates);
  EXPECT_EQ(best_template(matches, templates), 0U);
  EXPECT_NEAR(
      degrees_by_category(matches, {.shapes = {{"square", {}}}, .templates = templates}, OccupancyGrid(0.05), rule)
          .front()
          .degree,
      0.59, 1e-3);
  EXPECT_FALSE(fits_without_tolerance(matches_of(0.6, 0.59, 0.3, 0.3), templates, rule));
}

TEST(Classify, StaysUndecidedWhenAnotherCategoryTies) {
  // Means of sums over different numbers of cells, equal without rounding.
  const auto matches = matches_of(0.8, 0.7, 0.5, 0.8);
  const std::size_t best = best_template(matches, kTemplates);
  EXPECT_EQ(best, 0U);
  EXPECT_FALSE(is_decided(best, matches, kTemplates, {kMu, 0.6, 0.0, 0.0}));
}

TEST(Classify, DoesNotMindATieWithinOneCategory) {
  const auto matches = matches_of(0.5, 0.8, 0.8, 0.6);
  EXPECT_EQ(best_template(matches, kTemplates), 1U);
  EXPECT_TRUE(is_decided(1, matches, kTemplates, {kMu, 0.6, 0.0, 0.0}));
}

TEST(Classify, WantsTheMarginToTheNextCategoryOnly) {
  const auto matches = matches_of(0.72, 0.79, 0.8, 0.6);
  EXPECT_TRUE(is_decided(2, matches, kTemplates, {kMu, 0.6, 0.07, 0.0}));
  EXPECT_FALSE(is_decided(2, matches, kTemplates, {kMu, 0.6, 0.09, 0.0}));
}

// A template of two cells with gradients of 30 and 50: unseen floor misses 80.
LandmarkTemplate faint_shape() {
  return {"faint", 0.0, {{{0, 0}, 30, 0}, {{1, 0}, 30, 40}}};
}

TEST(AboveUnseen, Is0OverUnseenFloorAnd1ForAPerfectMatch) {
  EXPECT_EQ(unseen_mismatch(faint_shape()), 80 * kMismatchPerUnit);
  EXPECT_DOUBLE_EQ(above_unseen(80 * kMismatchPerUnit, faint_shape()), 0.0);
  EXPECT_DOUBLE_EQ(above_unseen(0, faint_shape()), 1.0);
  EXPECT_DOUBLE_EQ(above_unseen(20 * kMismatchPerUnit, faint_shape()), 0.75);
  EXPECT_LT(above_unseen(100 * kMismatchPerUnit, faint_shape()), 0.0);
}

TEST(Classify, DoesNotBelieveAFaintTemplateThatExplainsLittle) {
  // 60 of 200 missing is a degree of 0.7, but unseen floor already has 0.6 with this template.
  const std::vector<LandmarkTemplate> templates = {faint_shape()};
  const std::vector<TemplateMatch> matches = {{{0, 0}, 60 * kMismatchPerUnit}};
  EXPECT_NEAR(degree_of(matches[0].mismatch, 2, kMu), 0.7, 1e-12);
  EXPECT_TRUE(is_decided(0, matches, templates, {kMu, 0.6, 0.0, 0.0}));
  EXPECT_TRUE(is_decided(0, matches, templates, {kMu, 0.6, 0.0, 0.25}));
  EXPECT_FALSE(is_decided(0, matches, templates, {kMu, 0.6, 0.0, 0.26}));
}

TEST(Classify, KeepsOneEntryForSeveralTemplatesOfAnOrientation) {
  const std::vector<LandmarkTemplate> templates = {shape_of("square", 15, 10), shape_of("square", 15, 10),
                                                   shape_of("square", 30, 10)};
  const std::vector<TemplateMatch> matches = {match_of(0.7, 10), match_of(0.9, 10), match_of(0.8, 10)};
  const auto above = templates_above(matches, templates, {kMu, 0.6, 0.0, 0.0});
  ASSERT_EQ(above.size(), 2U);
  EXPECT_NEAR(above[0].degree, 0.9, 1e-3);
  EXPECT_NEAR(degrees(above[1].orientation_rad), 30.0, 1e-9);
}

TEST(Classify, ListsTheBestOfEveryCategoryWithItsPlace) {
  TemplateSet set;
  set.shapes = {{"circle", {}}, {"square", {}}, {"triangle", {}}};
  set.templates = kTemplates;
  const OccupancyGrid grid(0.05);
  const auto degrees = degrees_by_category(matches_of(0.5, 0.7, 0.8, 0.6), set, grid, {kMu, 0.6, 0.0, 0.0});
  ASSERT_EQ(degrees.size(), 3U);
  EXPECT_EQ(degrees[1].category, "square");
  EXPECT_NEAR(degrees[1].degree, 0.8, 1e-3);
  EXPECT_NEAR(degrees[1].orientation_rad, radians(15.0), 1e-12);
  EXPECT_EQ(degrees[1].at_m, grid.centre_of({3, 3}));
}

TEST(Classify, KeepsAllTemplatesAboveTauMatchBestFirst) {
  const auto above = templates_above(matches_of(0.65, 0.7, 0.8, 0.6), kTemplates, {kMu, 0.6, 0.0, 0.0});
  ASSERT_EQ(above.size(), 3U);
  EXPECT_NEAR(above[0].degree, 0.8, 1e-3);
  EXPECT_NEAR(above[1].degree, 0.7, 1e-3);
  EXPECT_EQ(above[2].category, "circle");
}

}  // namespace
}  // namespace cairn::template_matcher
