#include "plugins/template_matcher/match_kernels.hpp"

#include <gtest/gtest.h>

namespace cairn::template_matcher {
namespace {

TEST(Direction, IsNeverLongerThan1AndHardlyShorter) {
  for (int k = 0; k < kDirections; ++k) {
    const int squared = direction(k).x * direction(k).x + direction(k).y * direction(k).y;
    EXPECT_LE(squared, 16384 * 16384) << k;
    EXPECT_GT(squared, 16382 * 16382) << k;
  }
}

TEST(Direction, OfTheOtherHalfIsTheOpposite) {
  for (int k = 0; k < kDirections / 2; ++k) {
    EXPECT_EQ(direction(k).x, -direction(k + kDirections / 2).x);
    EXPECT_EQ(direction(k).y, -direction(k + kDirections / 2).y);
  }
  EXPECT_EQ(direction(0).x, 16384);
  EXPECT_EQ(direction(kDirections / 4).y, 16384);
}

}  // namespace
}  // namespace cairn::template_matcher
