#include "framework/experiments/recognition/precision_recall.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Two landmarks, found at 0.9 and 0.5; something false at 0.7 and two more at 0.2.
WorldCounts first_world() {
  return {2, {{0.9, 1, 1}, {0.7, 2, 1}, {0.5, 3, 2}, {0.2, 5, 2}}};
}
// Two landmarks, one found at 0.6.
WorldCounts second_world() {
  return {2, {{0.6, 1, 1}}};
}

TEST(PrecisionRecall, OfOneWorldByHand) {
  const std::vector worlds{first_world()};
  const std::vector<CurvePoint> curve = precision_recall(worlds);
  ASSERT_EQ(curve.size(), 4U);
  EXPECT_DOUBLE_EQ(curve[0].threshold, 0.9);
  EXPECT_DOUBLE_EQ(curve[0].precision, 1.0);
  EXPECT_DOUBLE_EQ(curve[0].recall, 0.5);
  EXPECT_DOUBLE_EQ(curve[0].f1, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(curve[2].precision, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(curve[2].recall, 1.0);
  EXPECT_DOUBLE_EQ(curve[2].f1, 0.8);
  EXPECT_DOUBLE_EQ(curve[3].precision, 0.4);
}

TEST(PrecisionRecall, AThresholdCountsInEveryWorld) {
  const std::vector worlds{first_world(), second_world()};
  const std::vector<CurvePoint> curve = precision_recall(worlds);
  ASSERT_EQ(curve.size(), 5U);
  EXPECT_DOUBLE_EQ(curve[2].threshold, 0.6);
  EXPECT_DOUBLE_EQ(curve[2].precision, 2.0 / 3.0) << "two of the first world, one of the second, two of them right";
  EXPECT_DOUBLE_EQ(curve[2].recall, 0.5);
  EXPECT_DOUBLE_EQ(curve[3].precision, 0.75) << "at 0.5 the second world still counts its one";
  EXPECT_DOUBLE_EQ(curve[3].recall, 0.75);
}

TEST(PrecisionRecall, TheBestThresholdHasTheHighestF1) {
  const std::vector worlds{first_world(), second_world()};
  const CurveFigures best = best_figures(worlds);
  EXPECT_DOUBLE_EQ(best.threshold, 0.5);
  EXPECT_DOUBLE_EQ(best.f1.value, 0.75);
  EXPECT_DOUBLE_EQ(best.precision.value, share_of(3, 4).value);
  EXPECT_DOUBLE_EQ(best.precision.low, share_of(3, 4).low);
  EXPECT_LT(best.f1.low, 0.75);
  EXPECT_GT(best.f1.high, 0.75);
}

TEST(PrecisionRecall, OfEqualF1TheHighestThresholdIsTheBest) {
  const std::vector worlds{WorldCounts{1, {{0.9, 1, 1}, {0.8, 1, 1}}}};
  EXPECT_DOUBLE_EQ(best_figures(worlds).threshold, 0.9);
}

TEST(PrecisionRecall, WithoutAnyDetectionThereIsNoCurve) {
  const std::vector worlds{WorldCounts{3, {}}};
  EXPECT_TRUE(precision_recall(worlds).empty());
  EXPECT_DOUBLE_EQ(best_figures(worlds).f1.value, 0.0);
  EXPECT_DOUBLE_EQ(figures_at(worlds, 0.5).recall.value, 0.0);
}

}  // namespace
}  // namespace cairn
