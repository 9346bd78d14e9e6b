#include "maps/geometry/bearing_maxima.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "maps/geometry/pose.hpp"

namespace cairn {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

TEST(BearingMaxima, AnswersAsALookAtEveryEntryDoes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> bearing(-std::numbers::pi, std::numbers::pi);
  std::uniform_real_distribution<double> value(-3.0, 3.0);
  for (const std::size_t count : {1U, 2U, 3U, 7U, 64U, 181U, 500U}) {
    std::vector<BearingMaxima::Entry> entries(count);
    for (auto& entry : entries) entry = {bearing(random), value(random)};
    const BearingMaxima maxima(entries);
    for (int i = 0; i < 200; ++i) {
      const double at_rad = 3.0 * bearing(random);
      const double half_rad = std::abs(bearing(random)) * (i % 3 == 0 ? 1.2 : 0.05);
      double largest = kNone;
      for (const auto& entry : entries)
        if (std::abs(wrap_angle(entry.bearing_rad - at_rad)) <= half_rad) largest = std::max(largest, entry.value);
      EXPECT_EQ(maxima.max_within(at_rad, half_rad), largest) << count << " entries, " << at_rad << " +- " << half_rad;
    }
  }
}

TEST(BearingMaxima, OfNothingSaysNothing) {
  EXPECT_TRUE(BearingMaxima().empty());
  EXPECT_EQ(BearingMaxima().max_within(0.3, 4.0), kNone);
}

}  // namespace
}  // namespace cairn
