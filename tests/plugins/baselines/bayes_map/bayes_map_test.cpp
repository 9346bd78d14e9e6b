#include "plugins/baselines/bayes_map/bayes_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>

#include "tests/plugins/common/sonar_model/cleared_footprint_law.hpp"

namespace cairn::bayes_map {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

RangeReading sonar(double range_m, const Pose2& T_robot_sensor = {}) {
  return {T_robot_sensor, radians(15.0), 0.1, 5.0, range_m, 0};
}

Observation observed(std::vector<RangeReading> ranges) {
  Observation observation;
  observation.ranges = std::move(ranges);
  return observation;
}

PoseEstimate at(const Pose2& T_map_robot) {
  return {T_map_robot, {}};
}

// The formulas of docs/method.md 2.1 for one cell centre in sensor coordinates.
int plain_increment(const Config& c, const RangeReading& reading, const Point& p) {
  const double r = p.norm();
  const double th = std::atan2(p.y(), p.x());
  if (std::abs(th) > reading.half_beam_rad) return 0;
  const double alpha =
      c.alpha_max * (1.0 - std::min(1.0, r / c.alpha_range_m)) * (1.0 - std::pow(th / reading.half_beam_rad, 2));
  const double delta = c.delta_m + c.delta_per_m * r;
  const auto Phi = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  const auto phi = [](double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi); };
  double lambda = 1.0;
  if (reading.range_m >= reading.max_m) {
    if (r <= reading.max_m) lambda = 1.0 - alpha * Phi((reading.max_m - r) / delta);
  } else if (r <= reading.range_m + 3.0 * delta) {
    const double z = (reading.range_m - r) / delta;
    lambda = 1.0 - alpha * Phi(z) + alpha * phi(z) / (c.false_echo_per_m * delta);
  }
  return static_cast<int>(std::lround(256.0 * std::log(lambda)));
}

// The whole grid by looking at every cell for every reading.
class PlainMap {
 public:
  explicit PlainMap(const Config& config) : config_(config) {}
  void integrate(const Observation& observation, const Pose2& T_map_robot) {
    const int clamp = static_cast<int>(std::lround(256.0 * config_.clamp_nat));
    for (const RangeReading& reading : observation.ranges) {
      const Pose2 T_sensor_map = inverse(T_map_robot * reading.T_robot_sensor);
      for (int y = -kReach; y < kReach; ++y)
        for (int x = -kReach; x < kReach; ++x) {
          const Point p = T_sensor_map * Point((x + 0.5) * config_.cell_m, (y + 0.5) * config_.cell_m);
          int& l = log_odds_[{x, y}];
          l = std::clamp(l + plain_increment(config_, reading, p), -clamp, clamp);
        }
    }
  }
  [[nodiscard]] int log_odds(Cell cell) const { return log_odds_.at(cell); }
  static constexpr int kReach = 110;

 private:
  Config config_;
  std::map<Cell, int> log_odds_;
};

TEST(BayesMap, EqualsThePlainFormulasCellByCell) {
  std::mt19937_64 random(51);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int run = 0; run < 3; ++run) {
    Config config;
    config.false_echo_per_m = 0.5 + 0.5 * run;
    config.clamp_nat = run == 1 ? 1.5 : 4.0;
    BayesMap map(config);
    PlainMap plain(config);
    for (int i = 0; i < 12; ++i) {
      const Pose2 T_map_robot{0.5 * unit(random), 0.5 * unit(random), wrap_angle(4.0 * unit(random))};
      const Pose2 T_robot_sensor{0.13, 0.1 * unit(random), unit(random)};
      RangeReading reading = sonar(i % 4 == 0 ? kInfinity : 0.1 + 4.8 * std::abs(unit(random)), T_robot_sensor);
      if (i % 5 == 0) reading.half_beam_rad = radians(25.0);
      if (i % 6 == 0) reading.max_m = 2.0;  // near enough for the bend of the no-echo model to count
      const Observation observation = observed({reading});
      (void)map.integrate(observation, at(T_map_robot));
      plain.integrate(observation, T_map_robot);
    }
    for (int y = -PlainMap::kReach; y < PlainMap::kReach; ++y)
      for (int x = -PlainMap::kReach; x < PlainMap::kReach; ++x)
        ASSERT_EQ(map.grid().log_odds({x, y}), plain.log_odds({x, y})) << x << ", " << y << " in run " << run;
  }
}

TEST(BayesMap, SaysFreeBeforeAnEchoOccupiedAtItAndNothingBehind) {
  BayesMap map{Config{}};
  (void)map.integrate(observed({sonar(1.0)}), at({0.025, 0.025, 0.0}));
  EXPECT_LT(map.grid().log_odds({10, 0}), -100);
  EXPECT_GT(map.grid().log_odds({20, 0}), 400);
  EXPECT_EQ(map.grid().log_odds({24, 0}), 0);
  EXPECT_EQ(map.grid().log_odds({-2, 0}), 0);
}

// What each reading means; the cell looked at lies 0.5 m ahead, the one behind it 1 m ahead.
struct Rule {
  const char* name;
  double range_m;
  bool is_free_ahead;
};
class ReadingRule : public testing::TestWithParam<Rule> {};

TEST_P(ReadingRule, IsKept) {
  BayesMap map{Config{}};
  const CellChanges changes = map.integrate(observed({sonar(GetParam().range_m)}), at({0.025, 0.025, 0.0}));
  EXPECT_EQ(map.grid().log_odds({10, 0}) < 0, GetParam().is_free_ahead);
  EXPECT_EQ(map.grid().log_odds({20, 0}) < 0, GetParam().is_free_ahead);
  EXPECT_EQ(changes.empty(), !GetParam().is_free_ahead);
  EXPECT_EQ(map.grid().bounds().empty(), !GetParam().is_free_ahead);
}

INSTANTIATE_TEST_SUITE_P(
    BayesMap, ReadingRule,
    testing::Values(Rule{"no_echo_is_infinite", kInfinity, true}, Rule{"no_echo_at_the_maximum", 5.0, true},
                    Rule{"no_echo_beyond_the_maximum", 7.5, true}, Rule{"an_echo_just_within", 4.999, true},
                    Rule{"too_near_to_tell", -kInfinity, false}, Rule{"bad", kNaN, false},
                    Rule{"negative", -1.0, false}, Rule{"zero", 0.0, false}, Rule{"below_the_minimum", 0.0999, false}),
    [](const auto& rule) { return std::string(rule.param.name); });

TEST(BayesMap, TakesTheMinimumRangeForAnEcho) {
  BayesMap map{Config{}};
  EXPECT_FALSE(map.integrate(observed({sonar(0.1)}), at({0.025, 0.025, 0.0})).empty());
}

TEST(BayesMap, GivesAnUnboundedSensorWithoutEchoTheWholeModel) {
  BayesMap map{Config{}};
  RangeReading reading = sonar(kInfinity);
  reading.max_m = kInfinity;
  (void)map.integrate(observed({reading}), at({0.025, 0.025, 0.0}));
  EXPECT_LT(map.grid().log_odds({70, 0}), 0);
  EXPECT_LE(map.grid().bounds().max.x, 80);
}

TEST(BayesMap, IgnoresReadingsAndPosesThatAreNoGeometry) {
  BayesMap map{Config{}};
  RangeReading nowhere = sonar(1.0, {kNaN, 0.0, 0.0});
  RangeReading inside_out = sonar(1.0);
  inside_out.half_beam_rad = -0.1;
  RangeReading nan_beam = sonar(1.0);
  nan_beam.half_beam_rad = kNaN;
  RangeReading no_range = sonar(kInfinity);
  no_range.max_m = kNaN;
  EXPECT_TRUE(map.integrate(observed({nowhere, inside_out, nan_beam, no_range}), at({})).empty());
  EXPECT_TRUE(map.integrate(observed({sonar(1.0)}), at({kInfinity, 0.0, 0.0})).empty());
  EXPECT_TRUE(map.integrate(observed({sonar(1.0)}), at({0.0, 0.0, kNaN})).empty());
  EXPECT_TRUE(map.grid().bounds().empty());
}

TEST(BayesMap, DrawsALineForARay) {
  BayesMap map{Config{}};
  RangeReading ray = sonar(1.0);
  ray.half_beam_rad = 0.0;
  const CellChanges changes = map.integrate(observed({ray}), at({0.025, 0.025, 0.0}));
  EXPECT_EQ(changes.spans.size(), 1U);
  EXPECT_LT(map.grid().log_odds({10, 0}), -100);
  EXPECT_GT(map.grid().log_odds({20, 0}), 400);
  EXPECT_EQ(map.grid().log_odds({10, 1}), 0);
}

TEST(BayesMap, ReportsEveryCellThatChangedInTidyRows) {
  std::mt19937_64 random(52);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  BayesMap map{Config{}};
  for (int i = 0; i < 60; ++i) {
    const OccupancyGrid before = map.grid();
    std::vector<RangeReading> ranges;
    for (int k = 0; k <= i % 4; ++k)
      ranges.push_back(sonar(2.5 * std::abs(unit(random)), {0.1, 0.0, 3.0 * unit(random)}));
    const CellChanges changes = map.integrate(observed(ranges), at({unit(random), unit(random), 3.0 * unit(random)}));
    for (std::size_t k = 1; k < changes.spans.size(); ++k) {
      const CellSpan& a = changes.spans[k - 1];
      const CellSpan& b = changes.spans[k];
      ASSERT_TRUE(a.y < b.y || (a.y == b.y && a.x_end < b.x_begin));
    }
    const auto reported = [&](Cell c) {
      for (const CellSpan& s : changes.spans)
        if (s.y == c.y && c.x >= s.x_begin && c.x < s.x_end) return true;
      return false;
    };
    const CellBox box = map.grid().bounds();
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x)
        ASSERT_TRUE(map.grid().log_odds({x, y}) == before.log_odds({x, y}) || reported({x, y})) << x << ", " << y;
  }
}

TEST(BayesMap, ReportsNothingOnceEverythingIsCertain) {
  BayesMap map{Config{}};
  const Observation wall = observed({sonar(1.0)});
  for (int i = 0; i < 2000; ++i) (void)map.integrate(wall, at({0.0, 0.0, 0.3}));
  EXPECT_TRUE(map.integrate(wall, at({0.0, 0.0, 0.3})).empty());
}

TEST(BayesMap, NeverGoesBeyondItsClamp) {
  Config config;
  config.clamp_nat = 2.0;
  BayesMap map(config);
  for (int i = 0; i < 100; ++i) (void)map.integrate(observed({sonar(1.0)}), at({}));
  const CellBox box = map.grid().bounds();
  int lowest = 0;
  int highest = 0;
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) {
      lowest = std::min<int>(lowest, map.grid().log_odds({x, y}));
      highest = std::max<int>(highest, map.grid().log_odds({x, y}));
    }
  EXPECT_EQ(lowest, -512);
  EXPECT_EQ(highest, 512);
}

TEST(BayesMap, GivesTheSameGridForTheSameReadings) {
  const auto mapped = [] {
    std::mt19937_64 random(53);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    BayesMap map{Config{}};
    for (int i = 0; i < 50; ++i)
      (void)map.integrate(observed({sonar(3.0 * std::abs(unit(random)))}),
                          at({unit(random), unit(random), 3.0 * unit(random)}));
    return map.grid();
  };
  EXPECT_EQ(mapped(), mapped());
}

TEST(BayesMap, DescribesAllItsSettings) {
  std::vector<std::string> keys;
  for (const FieldSpec& field : schema_of<Config>().fields) {
    keys.push_back(field.key);
    EXPECT_FALSE(field.meaning.empty()) << field.key;
  }
  EXPECT_EQ(keys, (std::vector<std::string>{"cell_m", "clamp_nat", "alpha_max", "alpha_range_m", "delta_m",
                                            "delta_per_m", "false_echo_per_m"}));
}

TEST(BayesMap, WhereTheRobotStandsIsFree) {
  sonar_model::expect_free_where_the_robot_stands(BayesMap{Config{}});
}

}  // namespace
}  // namespace cairn::bayes_map
