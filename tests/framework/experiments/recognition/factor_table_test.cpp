#include "framework/experiments/recognition/factor_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

ExperimentRow row_of(const std::string& variant, std::int64_t seed, const std::vector<Verdict>& verdicts) {
  ExperimentRow row;
  row.mission = "rooms";
  row.variant = variant;
  row.seed = seed;
  row.verdicts = verdicts;
  return row;
}

TEST(FactorPoints, AreOfTheFactorsOwnVariantsInItsOrder) {
  ExperimentConfig config;
  config.experiment = ExperimentKind::recognition;
  config.vary = {{"noise", "noise, m", {}, {"0", "0.1"}}, {"log", "log", {}, {"off"}}};
  config.variants.resize(4);
  config.variants[0].name = "plain";
  const char* const values[] = {"0", "0.1", "off"};
  for (std::size_t i = 0; i < 3; ++i) {
    config.variants[i + 1].factor = config.vary[i / 2].name;
    config.variants[i + 1].value = values[i];
    config.variants[i + 1].name = config.variants[i + 1].factor + " " + values[i];
  }
  const Verdict square{"square", "square", 0.02, std::nullopt, 1.0};
  const Verdict missed{"square", "", 0.0, std::nullopt, 0.0};
  const std::vector<ExperimentRow> rows = {row_of("plain", 1, {missed}), row_of("noise 0", 1, {square, square}),
                                           row_of("noise 0.1", 1, {square}), row_of("noise 0.1", 2, {missed}),
                                           row_of("log off", 1, {square})};
  const std::vector<FactorPoint> points = factor_points(config, config.vary[0], rows, "rooms");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].value, "0");
  EXPECT_EQ(points[0].figures.recall.value, 1.0);
  EXPECT_EQ(points[1].worlds, 2U);
  EXPECT_EQ(points[1].figures.recall.value, 0.5);
  const std::string text = factor_tables(config, rows);
  EXPECT_THAT(text, testing::HasSubstr("## rooms: noise\n\n| noise, m | worlds |"));
  EXPECT_THAT(text, testing::HasSubstr("\n| 0.1 | 2 | 1.000"));
  EXPECT_THAT(text, testing::HasSubstr("## rooms: log\n"));
}

}  // namespace
}  // namespace cairn
