#include "plugins/muriel/muriel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "tests/plugins/common/sonar_model/cleared_footprint_law.hpp"
#include "tests/plugins/muriel/test_readings.hpp"

namespace cairn::muriel {
namespace {

const Pose2 kMiddleOfCell0{0.025, 0.025, 0.0};

Config with_log(LogPolicy log) {
  Config config;
  config.log = log;
  return config;
}

TEST(Muriel, SaysFreeBeforeAnEchoOccupiedAtItAndNothingBehind) {
  Muriel map{Config{}};
  (void)map.integrate(observed({sonar(1.0)}), at(kMiddleOfCell0));
  EXPECT_LT(map.grid().log_odds({10, 0}), -80);
  EXPECT_GT(map.grid().log_odds({20, 0}), 300);
  EXPECT_EQ(map.grid().log_odds({25, 0}), 0);
  EXPECT_EQ(map.grid().log_odds({-2, 0}), 0);
}

// What each reading means; the cells looked at lie 0.5 m and 1 m ahead.
struct Rule {
  const char* name;
  double range_m;
  bool is_free_ahead;
};
class MurielRule : public testing::TestWithParam<Rule> {};

TEST_P(MurielRule, IsKept) {
  Muriel map{Config{}};
  const CellChanges changes = map.integrate(observed({sonar(GetParam().range_m)}), at(kMiddleOfCell0));
  EXPECT_EQ(map.grid().log_odds({10, 0}) < 0, GetParam().is_free_ahead);
  EXPECT_EQ(map.grid().log_odds({20, 0}) < 0, GetParam().is_free_ahead);
  EXPECT_EQ(changes.empty(), !GetParam().is_free_ahead);
  EXPECT_EQ(map.grid().bounds().empty(), !GetParam().is_free_ahead);
}

INSTANTIATE_TEST_SUITE_P(
    Muriel, MurielRule,
    testing::Values(Rule{"no_echo_is_infinite", kInfinity, true}, Rule{"no_echo_at_the_maximum", 5.0, true},
                    Rule{"no_echo_beyond_the_maximum", 7.5, true}, Rule{"an_echo_just_within", 4.999, true},
                    Rule{"too_near_to_tell", -kInfinity, false}, Rule{"bad", kNaN, false},
                    Rule{"negative", -1.0, false}, Rule{"zero", 0.0, false}, Rule{"below_the_minimum", 0.0999, false}),
    [](const auto& rule) { return std::string(rule.param.name); });

TEST(Muriel, IgnoresReadingsAndPosesThatAreNoGeometry) {
  Muriel map{Config{}};
  RangeReading inside_out = sonar(1.0);
  inside_out.half_beam_rad = -0.1;
  RangeReading nan_beam = sonar(1.0);
  nan_beam.half_beam_rad = kNaN;
  EXPECT_TRUE(map.integrate(observed({sonar(1.0, {kNaN, 0.0, 0.0}), inside_out, nan_beam}), at({})).empty());
  EXPECT_TRUE(map.integrate(observed({sonar(1.0)}), at({kInfinity, 0.0, 0.0})).empty());
  EXPECT_TRUE(map.grid().bounds().empty());
}

TEST(Muriel, DrawsALineForARayAndForAConeNarrowerThanACell) {
  for (const double half_beam_deg : {0.0, 0.25}) {
    Muriel map{Config{}};
    RangeReading ray = sonar(1.0);
    ray.half_beam_rad = radians(half_beam_deg);
    const CellChanges changes = map.integrate(observed({ray}), at(kMiddleOfCell0));
    EXPECT_EQ(changes.spans.size(), 1U);
    EXPECT_LT(map.grid().log_odds({10, 0}), -80);
    EXPECT_GT(map.grid().log_odds({20, 0}), 300);
  }
}

// A wall believed in 1 m ahead of cell (0, 0), across the whole beam.
void build_wall(Muriel& map) {
  for (int y = -8; y <= 8; ++y) map.grid().set_log_odds({20, y}, 900);
}
int wall_after(bool specular, double range_m) {
  Config config;
  config.specular = specular;
  Muriel map(config);
  build_wall(map);
  (void)map.integrate(observed({sonar(range_m)}), at(kMiddleOfCell0));
  return map.grid().log_odds({20, 0});
}

TEST(Muriel, AReadingThroughAKnownWallCountsLess) {
  EXPECT_LT(wall_after(false, 3.0), wall_after(true, 3.0));
  EXPECT_LT(wall_after(true, 3.0), 900);
  EXPECT_LT(wall_after(false, kInfinity), wall_after(true, kInfinity));
}

TEST(Muriel, AnEchoFromAKnownWallCountsAlmostFully) {
  Config config;
  config.clamp_nat = 20.0;
  Muriel map(config);
  build_wall(map);
  (void)map.integrate(observed({sonar(1.0)}), at(kMiddleOfCell0));
  Muriel plain(config);
  (void)plain.integrate(observed({sonar(1.0)}), at(kMiddleOfCell0));
  EXPECT_NEAR(map.grid().log_odds({20, 0}) - 900, plain.grid().log_odds({20, 0}), 30);
}

// Furthest that any cell lies from where it lay before: 1,000 identical readings against 5.
void expect_standing_still_adds_nothing(Config config, std::uint64_t seed) {
  Dice dice(seed);
  config.clamp_nat = 100.0;
  Muriel map(config);
  for (int i = 0; i < 30; ++i) (void)map.integrate(observed({dice.reading()}), at(dice.pose()));
  const Observation standing = observed({sonar(1.5), sonar(2.5, {0.1, 0.0, 0.5}), sonar(kInfinity, {0.1, 0.0, -0.8})});
  for (int i = 0; i < 5; ++i) (void)map.integrate(standing, at({0.1, 0.2, 0.3}));
  const OccupancyGrid after_five = map.grid();
  for (int i = 5; i < 1000; ++i) (void)map.integrate(standing, at({0.1, 0.2, 0.3}));
  EXPECT_EQ(map.grid(), after_five);
}

TEST(Muriel, AStandingRobotLearnsNothingMoreAfterFiveReadings) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    expect_standing_still_adds_nothing(with_log(LogPolicy::paper), seed);
    expect_standing_still_adds_nothing(with_log(LogPolicy::counted), seed);
  }
}

TEST(Muriel, WithoutALogAStandingRobotTalksItselfIntoCertainty) {
  Muriel map{with_log(LogPolicy::off)};
  for (int i = 0; i < 1000; ++i) (void)map.integrate(observed({sonar(1.5)}), at(kMiddleOfCell0));
  EXPECT_EQ(map.grid().log_odds({10, 0}), -map.grid().clamp_quanta());
}

TEST(Muriel, ThePaperPolicyTakesOneReadingFromEachBearing) {
  Muriel map{with_log(LogPolicy::paper)};
  (void)map.integrate(observed({sonar(1.0)}), at(kMiddleOfCell0));
  const int first = map.grid().log_odds({10, 0});
  (void)map.integrate(observed({sonar(2.0)}), at(kMiddleOfCell0));
  EXPECT_EQ(map.grid().log_odds({10, 0}), first);
  (void)map.integrate(observed({sonar(2.0)}), at({0.525, 0.525, -0.5 * std::numbers::pi}));  // from the side
  EXPECT_LT(map.grid().log_odds({10, 0}), first);
}

TEST(Muriel, TheCountedPolicyTakesFallingShares) {
  Config config;
  config.specular = false;
  Muriel map(config);
  const Observation silent = observed({sonar(kInfinity)});
  int before = 0;
  std::vector<int> steps;
  for (int i = 0; i < 4; ++i) {
    (void)map.integrate(silent, at(kMiddleOfCell0));
    steps.push_back(before - map.grid().log_odds({10, 0}));
    before = map.grid().log_odds({10, 0});
  }
  EXPECT_GT(steps[0], 100);
  EXPECT_NEAR(steps[1], steps[0] / 2.0, 1.0);
  EXPECT_NEAR(steps[2], steps[0] / 4.0, 1.0);
  EXPECT_EQ(steps[3], 0);
}

TEST(Muriel, ReportsOneSpanARowThatHoldsEveryChange) {
  Dice dice(61);
  Muriel map{Config{}};
  for (int i = 0; i < 60; ++i) {
    const OccupancyGrid before = map.grid();
    std::vector<RangeReading> ranges;
    for (int k = 0; k <= i % 4; ++k) ranges.push_back(dice.reading());
    const CellChanges changes = map.integrate(observed(ranges), at(dice.pose()));
    std::map<int, CellSpan> rows;
    for (std::size_t k = 0; k < changes.spans.size(); ++k) {
      ASSERT_TRUE(k == 0 || changes.spans[k - 1].y < changes.spans[k].y);
      rows[changes.spans[k].y] = changes.spans[k];
    }
    const CellBox box = map.grid().bounds();
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x) {
        if (map.grid().log_odds({x, y}) == before.log_odds({x, y})) continue;
        ASSERT_TRUE(rows.contains(y) && x >= rows[y].x_begin && x < rows[y].x_end) << x << ", " << y;
      }
  }
}

TEST(Muriel, NeverGoesBeyondItsClamp) {
  Config config = with_log(LogPolicy::off);
  config.clamp_nat = 2.0;
  Muriel map(config);
  for (int i = 0; i < 100; ++i) (void)map.integrate(observed({sonar(1.0)}), at({}));
  int lowest = 0;
  int highest = 0;
  const CellBox box = map.grid().bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) {
      lowest = std::min<int>(lowest, map.grid().log_odds({x, y}));
      highest = std::max<int>(highest, map.grid().log_odds({x, y}));
    }
  EXPECT_EQ(lowest, -512);
  EXPECT_EQ(highest, 512);
}

TEST(Muriel, HoldsAtMostTwelveBytesACell) {
  Muriel map{Config{}};
  // 40 x 40 m in touching beams.
  for (double y = -20.0; y <= 20.0; y += 0.4)
    for (double x = -20.0; x <= 20.0; x += 2.0) (void)map.integrate(observed({sonar(kInfinity)}), at({x, y, 0.0}));
  const CellBox box = map.grid().bounds();
  const double tiles = std::ceil(box.width() / 64.0 + 1.0) * std::ceil(box.height() / 64.0 + 1.0);
  EXPECT_LE(static_cast<double>(map.bytes()), 12.0 * tiles * 64 * 64);
  EXPECT_GT(map.bytes(), 800U * 800U * 10U);
}

TEST(Muriel, GrowsOverFourHundredMetresWhereverTheRobotGoes) {
  Muriel map{Config{}};
  for (double along = -200.0; along <= 200.0; along += 1.0) {
    (void)map.integrate(observed({sonar(2.0)}), at({along, 200.0, 0.1}));
    (void)map.integrate(observed({sonar(2.0)}), at({-200.0, along, 1.7}));
  }
  EXPECT_GE(map.grid().bounds().width(), 8000);
  EXPECT_GE(map.grid().bounds().height(), 8000);
  EXPECT_GT(map.grid().log_odds(map.grid().cell_at({202.0 * std::cos(0.0), 200.2})), 0);
}

TEST(Muriel, GivesTheSameGridForTheSameReadings) {
  const auto mapped = [] {
    Dice dice(62);
    Muriel map{Config{}};
    for (int i = 0; i < 50; ++i) (void)map.integrate(observed({dice.reading()}), at(dice.pose()));
    return map.grid();
  };
  EXPECT_EQ(mapped(), mapped());
}

TEST(Muriel, DescribesAllItsSettings) {
  std::vector<std::string> keys;
  for (const FieldSpec& field : schema_of<Config>().fields) {
    keys.push_back(field.key);
    EXPECT_FALSE(field.meaning.empty()) << field.key;
  }
  EXPECT_EQ(keys, (std::vector<std::string>{"cell_m", "clamp_nat", "alpha_max", "alpha_range_m", "delta_m",
                                            "delta_per_m", "false_echo_per_m", "specular", "specular_prior",
                                            "specular_per_m", "specular_sectors", "believed_p", "log", "log_bearings",
                                            "log_readings", "log_fall"}));
}

TEST(Muriel, WhereTheRobotStandsIsFree) {
  sonar_model::expect_free_where_the_robot_stands(Muriel{Config{}});
}

}  // namespace
}  // namespace cairn::muriel
