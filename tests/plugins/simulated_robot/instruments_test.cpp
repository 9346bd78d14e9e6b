#include "plugins/simulated_robot/instruments.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace cairn {
namespace {

struct Moments {
  double mean = 0.0;
  double deviation = 0.0;
};

// Of a value of the dead-reckoned pose after driving straight on, over many runs.
template <class Value>
Moments after_driving(const OdometryError& error, double distance_m, double step_m, Value value) {
  constexpr int kRuns = 4000;
  double sum = 0.0, squares = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    Odometer odometer(error, 0.1, static_cast<std::uint64_t>(run));
    for (int i = 0; i < std::lround(distance_m / step_m); ++i) odometer.add({step_m, 0.0, false});
    const double v = value(odometer.T_odom_robot());
    sum += v;
    squares += v * v;
  }
  const double mean = sum / kRuns;
  return {mean, std::sqrt(squares / kRuns - mean * mean)};
}

TEST(Odometer, DistanceErrorGrowsWithTheRootOfTheDistanceWhateverTheStep) {
  const OdometryError error{0.03, 0.0, 0.0};
  const auto x = [](const Pose2& p) { return p.x_m; };
  for (const double step_m : {0.01, 0.1}) {
    for (const double distance_m : {1.0, 4.0}) {
      const Moments found = after_driving(error, distance_m, step_m, x);
      EXPECT_NEAR(found.mean, distance_m, 0.003);
      EXPECT_NEAR(found.deviation, 0.03 * std::sqrt(distance_m), 0.05 * 0.03 * std::sqrt(distance_m));
    }
  }
}

TEST(Odometer, ConstantPartGrowsWithTheDistance) {
  const Moments found = after_driving({0.0, 0.02, 0.0}, 4.0, 0.1, [](const Pose2& p) { return p.x_m; });
  EXPECT_NEAR(found.mean, 4.0, 0.005);
  EXPECT_NEAR(found.deviation, 0.08, 0.004);
}

TEST(Odometer, HeadingErrorGrowsWithTheRootOfTheDistance) {
  const Moments found = after_driving({0.0, 0.0, radians(2.0)}, 4.0, 0.1, [](const Pose2& p) { return p.theta_rad; });
  EXPECT_NEAR(found.mean, 0.0, radians(0.2));
  EXPECT_NEAR(found.deviation, radians(4.0), radians(0.2));
}

TEST(Odometer, IsExactWithoutErrorsAndStandsStillWithTheRobot) {
  Odometer exact({}, 0.1, 1);
  Pose2 truth;
  for (int i = 0; i < 100; ++i) {
    exact.add({0.02, 0.03, false});
    truth = truth * along_arc(0.02, 0.03);
  }
  EXPECT_EQ(exact.T_odom_robot(), truth);
  Odometer still({0.1, 0.1, 0.1}, 0.1, 1);
  for (int i = 0; i < 100; ++i) still.add({});
  EXPECT_EQ(still.T_odom_robot(), Pose2{});
}

TEST(Compass, BiasIsBoundedSmoothAndItsOwnInEveryRun) {
  const double bound = radians(5.0);
  double largest = 0.0, squares = 0.0;
  int places = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Compass compass({0.0, bound, 2.0}, seed);
    for (double x = 0.0; x < 10.0; x += 0.5) {
      for (double y = 0.0; y < 10.0; y += 0.5) {
        const double bias = compass.bias_rad({x, y});
        largest = std::max(largest, std::abs(bias));
        squares += bias * bias;
        ++places;
        EXPECT_LT(std::abs(compass.bias_rad({x + 0.05, y}) - bias), 0.15 * bound) << "within 5 cm";
      }
    }
  }
  EXPECT_LE(largest, bound);
  EXPECT_GT(largest, 0.8 * bound);
  EXPECT_GT(std::sqrt(squares / places), 0.4 * bound);
  EXPECT_NE(Compass({0.0, bound, 2.0}, 1).bias_rad({1, 1}), Compass({0.0, bound, 2.0}, 2).bias_rad({1, 1}));
}

TEST(Compass, NoiseHasTheDeviationAsked) {
  Compass compass({radians(2.0), 0.0, 2.0}, 4);
  double squares = 0.0;
  constexpr int kReadings = 10000;
  for (int i = 0; i < kReadings; ++i) {
    const double error = wrap_angle(compass.read({0.0, 0.0, radians(179.5)}) - radians(179.5));
    squares += error * error;
  }
  EXPECT_NEAR(std::sqrt(squares / kReadings), radians(2.0), radians(0.08));
}

}  // namespace
}  // namespace cairn
