#include "framework/host/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

TEST(Estimate, IsStudentsInterval) {
  const Estimate estimate = estimate_of({1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(estimate.mean, 2.0);
  EXPECT_NEAR(estimate.half_width, 4.30265 / std::sqrt(3.0), 1e-4);  // t of 2 degrees of freedom at 97.5 %
  EXPECT_EQ(estimate_of({5.0}).half_width, 0.0);
}

}  // namespace
}  // namespace cairn
