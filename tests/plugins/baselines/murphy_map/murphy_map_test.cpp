#include "plugins/baselines/murphy_map/murphy_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/plugins/common/sonar_model/cleared_footprint_law.hpp"

namespace cairn::murphy_map {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kHalfBeam = radians(15.0);

// The book's sonar: R = 10, half-beam 15 degrees, tolerance 0.5, in its own unit of length.
Config of_the_book() {
  Config config;
  config.range_m = 10.0;
  config.tolerance_m = 0.5;
  return config;
}
double at(double cell_range_m, double bearing_deg, double echo_m) {
  return occupied_p(of_the_book(), cell_range_m, radians(bearing_deg), kHalfBeam, echo_m, 10.0);
}

TEST(Murphy, GivesTheWorkedExampleOfACellBeforeTheEcho) {
  EXPECT_NEAR(1.0 - at(3.5, 0.0, 6.0), 0.83, 0.0051);  // 0.825, printed as 0.83
  EXPECT_NEAR(at(3.5, 0.0, 6.0), 0.17, 0.0051);
}

TEST(Murphy, GivesTheWorkedExampleOfACellAtTheEcho) {
  EXPECT_NEAR(at(6.0, 5.0, 6.0), 0.52, 0.005);
  EXPECT_NEAR(1.0 - at(6.0, 5.0, 6.0), 0.48, 0.005);
}

TEST(Murphy, SaysNothingBehindTheEcho) {
  EXPECT_DOUBLE_EQ(at(6.6, 0.0, 6.0), 0.5);
}

TEST(Murphy, TurnsRoundFarOutUnlessAskedNotTo) {
  Config config = of_the_book();
  EXPECT_GT(occupied_p(config, 9.0, radians(14.0), kHalfBeam, kInfinity, 10.0), 0.9);
  config.keep_sign = true;
  EXPECT_DOUBLE_EQ(occupied_p(config, 9.0, radians(14.0), kHalfBeam, kInfinity, 10.0), 0.5);
}

Observation observed(double range_m) {
  Observation observation;
  observation.ranges = {{Pose2{}, kHalfBeam, 0.1, 5.0, range_m, 0}};
  return observation;
}
const PoseEstimate kMiddleOfCell0{{0.025, 0.025, 0.0}, {}};

TEST(MurphyMap, AddsTheLogOddsOfEachReading) {
  Config config;
  config.clamp_nat = 20.0;
  MurphyMap map(config);
  map.integrate(observed(1.0), kMiddleOfCell0);
  const double p = occupied_p(config, 0.5, 0.0, kHalfBeam, 1.0, 5.0);
  EXPECT_EQ(map.grid().log_odds({10, 0}), std::lround(256.0 * std::log(p / (1.0 - p))));
  EXPECT_GT(map.grid().log_odds({20, 0}), 0);
  EXPECT_EQ(map.grid().log_odds({23, 0}), 0);
  map.integrate(observed(1.0), kMiddleOfCell0);
  EXPECT_EQ(map.grid().log_odds({10, 0}), 2 * std::lround(256.0 * std::log(p / (1.0 - p))));
}

TEST(MurphyMap, EmptiesTheWholeBeamWithoutAnEcho) {
  MurphyMap map{Config{}};
  EXPECT_FALSE(map.integrate(observed(kInfinity), kMiddleOfCell0).empty());
  EXPECT_LT(map.grid().log_odds({10, 0}), 0);
  EXPECT_LT(map.grid().log_odds({60, 0}), 0);
}

TEST(MurphyMap, IgnoresWhatIsNoReading) {
  MurphyMap map{Config{}};
  for (const double range_m : {-1.0, 0.0, 0.05, -kInfinity, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_TRUE(map.integrate(observed(range_m), kMiddleOfCell0).empty()) << range_m;
  EXPECT_TRUE(map.integrate(observed(1.0), {{kInfinity, 0.0, 0.0}, {}}).empty());
  EXPECT_TRUE(map.grid().bounds().empty());
}

TEST(MurphyMap, DescribesAllItsSettings) {
  std::vector<std::string> keys;
  for (const FieldSpec& field : schema_of<Config>().fields) keys.push_back(field.key);
  EXPECT_EQ(keys,
            (std::vector<std::string>{"cell_m", "clamp_nat", "range_m", "tolerance_m", "max_occupied_p", "keep_sign"}));
}

TEST(MurphyMap, WhereTheRobotStandsIsFree) {
  sonar_model::expect_free_where_the_robot_stands(MurphyMap{Config{}});
}

}  // namespace
}  // namespace cairn::murphy_map
