#include "framework/reporting/thinned_series.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

ThinnedSeries<int> series_of(int count, std::size_t max_samples) {
  ThinnedSeries<int> series(max_samples);
  for (int i = 0; i < count; ++i) series.add(i);
  return series;
}

TEST(ThinnedSeries, HoldsEverySampleUpToItsBound) {
  const ThinnedSeries<int> series = series_of(100, 100);
  ASSERT_EQ(series.samples().size(), 100U);
  EXPECT_EQ(series.samples().back(), 99);
  EXPECT_EQ(series.every(), 1);
}

TEST(ThinnedSeries, HoldsSamplesAtEvenIntervalsAndNoMoreThanItsBound) {
  for (const std::size_t max_samples : {2U, 7U, 10U, 100U}) {
    for (const int count : {101, 250, 1023, 1024, 1025, 100000}) {
      const ThinnedSeries<int> series = series_of(count, max_samples);
      EXPECT_LE(series.samples().size(), max_samples);
      EXPECT_GE(2 * (series.samples().size() + 1), max_samples);
      EXPECT_LT(count - 1 - series.samples().back(), series.every());
      for (std::size_t i = 0; i < series.samples().size(); ++i)
        ASSERT_EQ(series.samples()[i], static_cast<int>(i) * series.every()) << count << " of " << max_samples;
    }
  }
}

}  // namespace
}  // namespace cairn
