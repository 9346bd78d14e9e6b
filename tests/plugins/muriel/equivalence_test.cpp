// The fast evaluation against the plain one.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdlib>
#include <limits>
#include <numbers>
#include <vector>

#include "plugins/muriel/muriel.hpp"
#include "plugins/muriel/plain_muriel.hpp"
#include "tests/plugins/muriel/test_readings.hpp"

namespace cairn::muriel {
namespace {

// More than any beam of the Dice reaches at 0.05 m a cell.
constexpr int kReach_cells = 180;
constexpr CellBox kEverything{{-kReach_cells, -kReach_cells}, {kReach_cells, kReach_cells}};

template <class Visit>
void for_each_cell(const Visit& visit) {
  for (int y = kEverything.min.y; y < kEverything.max.y; ++y)
    for (int x = kEverything.min.x; x < kEverything.max.x; ++x) visit(Cell{x, y});
}

// The same random map and logs in both: mostly free, walls here and there, some of it unknown.
void fill(Dice& dice, Muriel& fast, PlainMuriel& plain) {
  for_each_cell([&](Cell cell) {
    const bool wall = dice.below(12) == 0;
    const auto value = static_cast<LogOdds>(dice.below(5) == 0 ? 0 : (wall ? 1 : -1) * dice.below(1500));
    const std::uint64_t counts = dice.word() & dice.word() & dice.word();
    fast.grid().set_log_odds(cell, value);
    plain.grid().set_log_odds(cell, value);
    for (int bucket = 0; bucket < kMaxBearings; ++bucket) {
      const int count = static_cast<int>(counts >> (2 * bucket)) & kMaxReadings;
      fast.log().set_count(cell, bucket, count);
      plain.log().set_count(cell, bucket, count);
    }
  });
}

bool holds(const CellChanges& changes, Cell cell) {
  for (const CellSpan& span : changes.spans)
    if (span.y == cell.y && cell.x >= span.x_begin && cell.x < span.x_end) return true;
  return false;
}

TEST(MurielEquivalence, OneReadingGivesTheSameCellsAndValuesToOneQuantum) {
  Dice dice(71);
  for (int run = 0; run < 16; ++run) {
    const Config config = dice.config();
    Muriel fast(config);
    PlainMuriel plain(config);
    fill(dice, fast, plain);
    for (int i = 0; i < 8; ++i) {
      const OccupancyGrid before = fast.grid();
      const IndependenceLog& fast_log = fast.log();
      const RangeReading reading = dice.reading();
      const Pose2 pose = dice.pose();
      const CellChanges changes = fast.integrate(observed({reading}), at(pose));
      plain.integrate(observed({reading}), at(pose));
      for_each_cell([&](Cell cell) {
        const int was = before.log_odds(cell);
        const int has = fast.grid().log_odds(cell);
        const int wanted = plain.grid().log_odds(cell);
        ASSERT_LE(std::abs(has - wanted), 1)
            << cell.x << ", " << cell.y << " run " << run << " reading " << i << " was " << was << " range "
            << reading.range_m << " half " << degrees(reading.half_beam_rad);
        // A log may differ only where an increment was so near to half a quantum that one of the two rounded it to 0.
        bool same_log = true;
        for (int bucket = 0; bucket < kMaxBearings; ++bucket)
          if (const int count = fast_log.count(cell, bucket); count != plain.log().count(cell, bucket)) {
            same_log = false;
            plain.log().set_count(cell, bucket, count);
          }
        ASSERT_TRUE(same_log || std::abs(wanted - was) + std::abs(has - was) <= 1) << cell.x << ", " << cell.y;
        ASSERT_TRUE(has == was || holds(changes, cell)) << cell.x << ", " << cell.y;
        plain.grid().set_log_odds(cell, static_cast<LogOdds>(has));
      });
      if (HasFatalFailure()) return;
    }
  }
}

// A whole scan of a laser, whose beams cross the same cells near the sensor.
TEST(MurielEquivalence, AScanGivesTheSameCellsAndValuesToAQuantumABeam) {
  Dice dice(72);
  for (int run = 0; run < 3; ++run) {
    const Config config = dice.config();
    Muriel fast(config);
    PlainMuriel plain(config);
    fill(dice, fast, plain);
    for (int i = 0; i < 20; ++i) {
      RangeReading beam = dice.reading();
      beam.half_beam_rad = 0.0;
      beam.T_robot_sensor = {0.1, 0.0, radians(9.0 * i - 90.0)};
      const Pose2 pose{0.31, -0.17, 0.4};
      const CellChanges changes = fast.integrate(observed({beam}), at(pose));
      plain.integrate(observed({beam}), at(pose));
      for_each_cell([&](Cell cell) {
        const int wanted = plain.grid().log_odds(cell);
        const int has = fast.grid().log_odds(cell);
        ASSERT_LE(std::abs(has - wanted), 1) << cell.x << ", " << cell.y << " run " << run << " beam " << i;
        plain.grid().set_log_odds(cell, static_cast<LogOdds>(has));
      });
      if (HasFatalFailure()) return;
    }
  }
}

TEST(MurielEquivalence, TheWorkOfAScanGrowsWithItsBeamsAndNotWithTheirSquare) {
  const auto cells_of = [](int beams) {
    Muriel map{Config{}};
    Observation scan;
    for (int i = 0; i < beams; ++i)
      scan.ranges.push_back({{0.0, 0.0, radians(270.0) * i / (beams - 1)}, 0.0, 0.05, 8.0, 3.0, i});
    (void)map.integrate(scan, at({0.01, 0.02, 0.3}));
    return static_cast<double>(map.cells_on_rays());
  };
  EXPECT_NEAR(cells_of(2000) / cells_of(500), 4.0, 0.1);
  EXPECT_LT(cells_of(1080) / 1080, 140.0) << "cells a beam: those on its line";
}

TEST(MurielEquivalence, LightIsNeverSpecular) {
  Config trusting;
  trusting.specular_prior = 0.9;
  Config plain;
  plain.specular = false;
  Muriel map(trusting);
  Muriel same(plain);
  for (const double range_m : {1.0, 1.0, 1.0, 3.0}) {  // the last through what the map takes for a wall
    const RangeReading beam{{}, 0.0, 0.05, 8.0, range_m, 0};
    (void)map.integrate(observed({beam}), at({0.01, 0.02, 0.3}));
    (void)same.integrate(observed({beam}), at({0.01, 0.02, 0.3}));
  }
  EXPECT_TRUE(map.grid() == same.grid());
}

// There the cells behind the sensor lie on its axis to the last bit.
TEST(MurielEquivalence, HoldsOnCellCentresAlongTheRowsAndColumns) {
  for (const double heading_rad : {0.0, std::numbers::pi / 2.0, std::numbers::pi, -std::numbers::pi / 2.0})
    for (const double range_m : {0.6, 2.0, std::numeric_limits<double>::infinity()}) {
      Muriel fast{Config{}};
      PlainMuriel plain{Config{}};
      const RangeReading reading{{}, radians(15.0), 0.1, 5.0, range_m, 0};
      const Pose2 pose{0.025, 0.025, heading_rad};
      fast.integrate(observed({reading}), at(pose));
      plain.integrate(observed({reading}), at(pose));
      for_each_cell([&](Cell cell) {
        ASSERT_NEAR(fast.grid().log_odds(cell), plain.grid().log_odds(cell), 1)
            << cell.x << ", " << cell.y << " heading " << degrees(heading_rad) << " range " << range_m;
      });
    }
}

TEST(MurielEquivalence, EveryInstructionSetGivesTheSameBits) {
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  if (targets.size() == 1) GTEST_SKIP() << "this machine has one set only";
  Dice dice(73);
  for (int run = 0; run < 40; ++run) {
    const Config config = dice.config();
    std::vector<Muriel> maps;
    for (std::size_t k = 0; k < targets.size(); ++k) maps.emplace_back(config);
    for (int i = 0; i < 30; ++i) {
      const Observation observation = observed({dice.reading()});
      const Pose2 pose = dice.pose();
      for (std::size_t k = 0; k < targets.size(); ++k) {
        hwy::SetSupportedTargetsForTest(targets[k]);
        maps[k].integrate(observation, at(pose));
        hwy::SetSupportedTargetsForTest(0);
        ASSERT_EQ(maps[k].grid(), maps[0].grid())
            << "run " << run << " reading " << i << " " << hwy::TargetName(targets[k]);
      }
    }
  }
}

TEST(MurielEquivalence, AFreshMapGrowsToTheSameBounds) {
  Dice dice(72);
  for (int run = 0; run < 40; ++run) {
    const Config config = dice.config();
    Muriel fast(config);
    PlainMuriel plain(config);
    for (int i = 0; i < 5; ++i) {
      const Observation observation = observed({dice.reading()});
      const Pose2 pose = dice.pose();
      fast.integrate(observation, at(pose));
      plain.integrate(observation, at(pose));
    }
    const CellBox a = fast.grid().bounds();
    const CellBox b = plain.grid().bounds();
    EXPECT_LE(std::max(distance8(a.min, b.min), distance8(a.max, b.max)), 1) << run;
  }
}

}  // namespace
}  // namespace cairn::muriel
