#include "plugins/muriel/independence_log.hpp"

#include <gtest/gtest.h>

#include "maps/geometry/pose.hpp"

namespace cairn::muriel {
namespace {

TEST(IndependenceLog, CountsEachBearingOfEachCellOnItsOwn) {
  IndependenceLog log;
  log.set_count({-1, 64}, 31, 3);
  log.set_count({-1, 64}, 31, 2);
  log.set_count({-1, 64}, 5, 1);
  for (int bucket = 0; bucket < kMaxBearings; ++bucket) {
    EXPECT_EQ(log.count({-1, 64}, bucket), bucket == 31 ? 2 : bucket == 5 ? 1 : 0);
    EXPECT_EQ(log.count({0, 64}, bucket), 0);
    EXPECT_EQ(log.count({1000, 1000}, bucket), 0);
  }
}

TEST(IndependenceLog, BucketsTurnAnticlockwiseWithDirectionZeroInTheMiddleOfTheFirst) {
  EXPECT_EQ(bucket_of(0.0, 32), 0);
  EXPECT_EQ(bucket_of(radians(5.6), 32), 0);
  EXPECT_EQ(bucket_of(radians(-5.6), 32), 0);
  EXPECT_EQ(bucket_of(radians(5.7), 32), 1);
  EXPECT_EQ(bucket_of(radians(-5.7), 32), 31);
  EXPECT_EQ(bucket_of(radians(180.0), 32), 16);
  EXPECT_EQ(bucket_of(radians(-180.0), 32), 16);
  EXPECT_EQ(bucket_of(radians(359.0), 4), 0);
  EXPECT_EQ(bucket_of(radians(-400.0), 4), 0);
}

TEST(IndependenceLog, WeighsReadingsAsThePolicySays) {
  Config config;
  config.log = LogPolicy::off;
  EXPECT_EQ(weights_of(config), (Weights{1.0, 1.0, 1.0, 1.0}));
  config.log = LogPolicy::paper;
  EXPECT_EQ(weights_of(config), (Weights{1.0, 0.0, 0.0, 0.0}));
  config.log = LogPolicy::counted;
  config.log_readings = 2;
  config.log_fall = 0.25;
  EXPECT_EQ(weights_of(config), (Weights{1.0, 0.25, 0.0, 0.0}));
  config.log_readings = 3;
  EXPECT_EQ(weights_of(config), (Weights{1.0, 0.25, 0.0625, 0.0}));
}

}  // namespace
}  // namespace cairn::muriel
