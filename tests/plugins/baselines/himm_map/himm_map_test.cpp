#include "plugins/baselines/himm_map/himm_map.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/plugins/common/sonar_model/cleared_footprint_law.hpp"

namespace cairn::himm_map {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Pose2 kMiddleOfCell0{0.025, 0.025, 0.0};

const CellChanges& integrate(HimmMap& map, double range_m, const Pose2& T_map_robot = kMiddleOfCell0) {
  Observation observation;
  observation.ranges = {{Pose2{}, radians(15.0), 0.1, 5.0, range_m, 0}};
  return map.integrate(observation, {T_map_robot, {}});
}

TEST(HimmMap, AddsThreeAtTheEchoAndTakesOneBeforeIt) {
  HimmMap map{Config{}};
  for (int i = 0; i < 3; ++i) integrate(map, 0.5);
  EXPECT_EQ(map.certainty({10, 0}), 9);
  integrate(map, 1.0);
  EXPECT_EQ(map.certainty({10, 0}), 8);
  EXPECT_EQ(map.certainty({20, 0}), 3);
  EXPECT_EQ(map.certainty({5, 0}), 0);
}

TEST(HimmMap, KeepsToItsRange) {
  HimmMap map{Config{}};
  for (int i = 0; i < 20; ++i) integrate(map, 0.5);
  EXPECT_EQ(map.certainty({10, 0}), 15);
  for (int i = 0; i < 20; ++i) integrate(map, kInfinity);
  EXPECT_EQ(map.certainty({10, 0}), 0);
}

// In the middle of an even scale a cell is as likely free as occupied, but no longer unseen.
TEST(HimmMap, AnEvenScaleCountsThroughItsMiddle) {
  Config config;
  config.certainty_max = 6;
  config.growth = false;
  HimmMap map{config};
  integrate(map, 0.5);
  EXPECT_EQ(map.certainty({10, 0}), 3);
  integrate(map, 0.5);
  EXPECT_EQ(map.certainty({10, 0}), 6);
}

TEST(HimmMap, TouchesTheAcousticAxisOnly) {
  HimmMap map{Config{}};
  const CellChanges changes = integrate(map, 1.0);
  for (const CellSpan& span : changes.spans) EXPECT_EQ(span.y, 0);
  EXPECT_EQ(map.grid().bounds(), (CellBox{{0, 0}, {21, 1}}));
}

TEST(HimmMap, ShowsCertaintyAsProbabilityAndTheUnseenAsUnknown) {
  HimmMap map{Config{}};
  integrate(map, 0.5);
  EXPECT_NEAR(probability_of(map.grid().log_odds({10, 0})), 3.5 / 16.0, 1e-3);
  EXPECT_NEAR(probability_of(map.grid().log_odds({5, 0})), 0.5 / 16.0, 1e-3);
  EXPECT_EQ(map.grid().ol({10, 1}), kUnknownOl);
  EXPECT_EQ(map.grid().ol({11, 0}), kUnknownOl);
}

TEST(HimmMap, GrowsFasterBesideWhatIsAlreadyCertain) {
  Config config;
  config.growth = true;
  HimmMap map(config);
  integrate(map, 0.5);
  integrate(map, 0.5);  // 6 at (10, 0)
  integrate(map, 0.5, {0.025, 0.075, 0.0});
  EXPECT_EQ(map.certainty({10, 1}), 3 + 6 / 2);
}

TEST(HimmMap, IgnoresWhatIsNoReading) {
  HimmMap map{Config{}};
  for (const double range_m : {-1.0, 0.0, 0.05, -kInfinity, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_TRUE(integrate(map, range_m).empty()) << range_m;
  EXPECT_TRUE(integrate(map, 1.0, {kInfinity, 0.0, 0.0}).empty());
  EXPECT_TRUE(map.grid().bounds().empty());
}

TEST(HimmMap, DescribesAllItsSettings) {
  std::vector<std::string> keys;
  for (const FieldSpec& field : schema_of<Config>().fields) keys.push_back(field.key);
  EXPECT_EQ(keys, (std::vector<std::string>{"cell_m", "increment", "decrement", "certainty_max", "range_m", "growth"}));
}

TEST(HimmMap, WhereTheRobotStandsIsFree) {
  sonar_model::expect_free_where_the_robot_stands(HimmMap{Config{}});
}

}  // namespace
}  // namespace cairn::himm_map
