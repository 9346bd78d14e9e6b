#include "framework/experiments/homes/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

ExperimentConfig homes_with_tags() {
  ExperimentConfig config;
  config.experiment = ExperimentKind::homes;
  config.variants = {{"camera", {}}};
  config.at_least_ratio = 0.9;
  return config;
}

ExperimentRow explored(std::int64_t seed, const TagVerdict& tags) {
  ExperimentRow row;
  row.variant = "camera";
  row.seed = seed;
  row.home = HomeVerdict{5, 5, 50.0, 1.0, 100.0, 0, 0, true, "nothing left", {}};
  row.tags = tags;
  return row;
}

TEST(HomesTable, CountsTheTagsOfAllHomes) {
  const std::vector<ExperimentRow> rows{explored(1, {10, 9, 9, 1, 0, 50, 0, {0.01, 0.03}, {0.5, 0.7}}),
                                        explored(2, {10, 7, 6, 0, 0, 40, 1, {0.05}, {2.5}})};
  const std::string table = homes_table(homes_with_tags(), rows);
  EXPECT_THAT(table, testing::HasSubstr("| camera | 2 | 20 | 16 | 15 of 16: 0.938")) << table;
  EXPECT_THAT(table, testing::HasSubstr("; 0.050 |")) << "the largest error\n" << table;
  EXPECT_THAT(table, testing::HasSubstr("1 of 90 |")) << "false sightings\n" << table;
  EXPECT_TRUE(keeps_homes_limits(homes_with_tags(), rows));
}

TEST(HomesTable, MissedAndFalseTagsBreakItsLimits) {
  EXPECT_FALSE(keeps_homes_limits(homes_with_tags(), {explored(1, {10, 10, 8, 0, 0, 50, 0, {}, {}})}));
  EXPECT_FALSE(keeps_homes_limits(homes_with_tags(), {explored(1, {10, 10, 10, 0, 1, 50, 0, {}, {}})}));
}

TEST(HomesTable, SaysNothingOfTagsWhereNoneHang) {
  ExperimentRow row = explored(1, {});
  row.tags.reset();
  EXPECT_THAT(homes_table(homes_with_tags(), {row}), testing::Not(testing::HasSubstr("in sight")));
  EXPECT_TRUE(keeps_homes_limits(homes_with_tags(), {row}));
}

}  // namespace
}  // namespace cairn
