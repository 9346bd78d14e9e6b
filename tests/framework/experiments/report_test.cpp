#include "framework/experiments/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using testing::HasSubstr;
using testing::Not;

ExperimentRow row_of(const std::string& variant, std::int64_t seed, double log_loss) {
  ExperimentRow row;
  row.mission = "hallway";
  row.variant = variant;
  row.seed = seed;
  row.quality = MapQuality{};
  row.quality->log_loss = log_loss;
  return row;
}

ExperimentConfig maps_of_two() {
  ExperimentConfig config;
  config.experiment = ExperimentKind::maps;
  config.variants = {{"plain", {}}, {"better", {}}};
  config.baseline = "plain";
  return config;
}

TEST(ExperimentReport, TheDifferenceIsTakenSeedBySeed) {
  const std::vector<ExperimentRow> rows{row_of("plain", 1, 0.2), row_of("plain", 2, 0.8), row_of("better", 1, 0.1),
                                        row_of("better", 2, 0.7)};
  const std::string table = table_of(maps_of_two(), rows);
  EXPECT_THAT(table, HasSubstr("log loss less plain's"));
  EXPECT_THAT(table, HasSubstr("-0.1000 ± 0.0000 |")) << table;
  EXPECT_THAT(table, Not(HasSubstr("held-out"))) << "nothing was held out";
}

// An interrupted experiment has rows that never ran, and others of half a drive.
TEST(ExperimentReport, RunsThatDidNotEndWellAreLeftOutAndCounted) {
  std::vector<ExperimentRow> rows{row_of("plain", 1, 0.2), row_of("plain", 2, 0.4), row_of("better", 1, 0.1),
                                  row_of("better", 2, 9.0)};
  rows[3].result.outcome = MissionOutcome::cancelled;
  rows[3].quality.reset();
  const std::string table = table_of(maps_of_two(), rows);
  EXPECT_THAT(table, testing::StartsWith("**Cancelled: 1 of 4 runs did not come to their end.**\n"));
  EXPECT_THAT(table, HasSubstr("1 that did not end well left out"));
  EXPECT_THAT(table, HasSubstr("| better | 0.1000 |"));
  EXPECT_THAT(table, HasSubstr("| -0.1000 |")) << "of the one seed that both have, which has no interval";
}

TEST(ExperimentReport, WithoutATrueWorldOnlyHeldOutReadingsCount) {
  ExperimentConfig config = maps_of_two();
  config.hold_out_every = 5;
  std::vector<ExperimentRow> rows{row_of("plain", 1, 0.0), row_of("better", 1, 0.0)};
  for (ExperimentRow& row : rows) {
    row.quality.reset();
    row.held_out = 3;
  }
  rows[1].held_out_log_likelihood = -1.5;
  const std::string table = table_of(config, rows);
  EXPECT_THAT(table, HasSubstr("| variant | held-out log-likelihood |"));
  EXPECT_THAT(table, HasSubstr("| better | -1.5000"));
  EXPECT_THAT(table, Not(HasSubstr("Brier")));
}

}  // namespace
}  // namespace cairn
