#include "framework/experiments/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

TEST(Estimate, IsStudentsInterval) {
  const Estimate estimate = estimate_of({1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(estimate.mean, 2.0);
  EXPECT_NEAR(estimate.half_width, 4.30265 / std::sqrt(3.0), 1e-4);  // t of 2 degrees of freedom at 97.5 %
  EXPECT_EQ(text_of(estimate, 2), "2.00 ± 2.48");
}

TEST(Estimate, OfOneValueHasNoInterval) {
  EXPECT_EQ(text_of(estimate_of({5.0}), 1), "5.0");
  EXPECT_EQ(text_of(estimate_of({5.0, 5.0}), 1), "5.0 ± 0.0") << "two that agree have one";
}

TEST(Share, HasWilsonsInterval) {
  const Interval share = share_of(9, 10);
  EXPECT_DOUBLE_EQ(share.value, 0.9);
  EXPECT_NEAR(share.low, 0.5958, 1e-3);
  EXPECT_NEAR(share.high, 0.9821, 1e-3);
  EXPECT_LT(share_of(10, 10).low, 0.75) << "ten of ten is not certainty";
  EXPECT_EQ(share_of(0, 0).high, 1.0);
}

TEST(Resampled, SpansWhatOtherRunsMightHaveGiven) {
  const std::vector<double> runs{1.0, 2.0, 3.0, 4.0};
  const auto mean = [&](std::span<const std::size_t> taken) {
    double sum = 0.0;
    for (const std::size_t index : taken) sum += runs[index];
    return sum / static_cast<double>(taken.size());
  };
  const Interval interval = resampled(runs.size(), mean);
  EXPECT_DOUBLE_EQ(interval.value, 2.5);
  EXPECT_NEAR(interval.low, 1.5, 0.26);
  EXPECT_NEAR(interval.high, 3.5, 0.26);
  EXPECT_EQ(resampled(runs.size(), mean).low, interval.low) << "the same again";
  EXPECT_EQ(text_of(resampled(1, mean)), "1.000") << "one run says nothing of others";
}

TEST(Median, IsTheMiddle) {
  EXPECT_EQ(median_of({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median_of({4.0, 1.0, 2.0, 3.0}), 2.5);
}

}  // namespace
}  // namespace cairn
