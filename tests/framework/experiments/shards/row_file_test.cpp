#include "framework/experiments/shards/row_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "framework/experiments/report.hpp"

namespace cairn {
namespace {

ExperimentRow measured_row() {
  ExperimentRow row;
  row.mission = "office";
  row.variant = "a \"b\"\nc";
  row.seed = 1'234'567'890'123;
  row.result.outcome = MissionOutcome::step_failed;
  row.result.reason = "it was late, and \xc3\xa4";
  row.result.distance_m = 0.1 + 0.2;
  row.result.time_s = 1.0 / 3.0;
  row.result.matchings = 17;
  row.result.map_file = "office.cairn";
  row.score = {{{3, 0.012345678901234567}}, 1, 2};
  row.worst_error_m = std::numeric_limits<double>::denorm_min();
  row.quality = MapQuality{10, 20, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  row.held_out_log_likelihood = -std::numeric_limits<double>::infinity();
  row.places = {{{0.5, 0.25}, 3.5}, {{}, 0.0}};
  row.orbit = {{0.5, {0.1}, {{15, 0.75}, {30, 0.5}}}};
  row.verdicts = {{"square", "round", 0.1, std::nullopt, 4.0}, {"", "cube", 0.0, 0.25, 1.0}};
  row.ring.ol[3] = 12.5;
  row.ring.cells[3] = 4;
  row.sweeps = {{"ours", {3, {{0.9, 1, 1}, {0.8, 2, 1}}}, 0.01}};
  row.contacts = {{12.5, {0.3, true}}};
  row.trial.emplace();
  row.trial->goals = {{"3/1", "goto L1", 1.0, 2.0, GoalEnd::false_success, "here", 0.4, true, false, true, false}};
  row.trial->stand = {1.5, 120.25};
  row.trial->silences = {2, 3};
  row.home = HomeVerdict{5, 4, 80.5, 0.875, std::nullopt, 1, 0, true, "all is explored", {3}};
  row.tags = TagVerdict{10, 9, 8, 1, 0, 100, 2, {0.01, 0.02}, {0.5}};
  row.tick = {"tick", "host", 5, 1.5, 2.5, 3.5, 0.001, 0.0005};
  row.wall_s = 1.25;
  row.gave_up = true;
  return row;
}

std::string refusal_of(const std::string& text, const std::string& experiment = "0123") {
  try {
    static_cast<void>(row_from(text, experiment));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(RowFile, ReadsBackAllThatWasMeasured) {
  const ExperimentRow row = measured_row();
  const std::string text = row_text(row, "0123");
  const ExperimentRow again = row_from(text, "0123");
  EXPECT_EQ(row_text(again, "0123"), text);
  EXPECT_EQ(again.result.distance_m, 0.1 + 0.2);
  EXPECT_EQ(again.worst_error_m, row.worst_error_m);
  EXPECT_EQ(again.held_out_log_likelihood, row.held_out_log_likelihood);
  EXPECT_EQ(again.variant, row.variant);
  ASSERT_TRUE(again.trial);
  EXPECT_EQ(again.trial->goals[0].end, GoalEnd::false_success);
  EXPECT_TRUE(again.trial->goals[0].is_struck);
  EXPECT_FALSE(again.verdicts[0].orientation_error_rad);
  EXPECT_EQ(again.orbit[0].templates, row.orbit[0].templates);
}

TEST(RowFile, MakesTheSameTablesOfEveryKind) {
  const ExperimentRow row = measured_row();
  const ExperimentRow again = row_from(row_text(row, "0123"), "0123");
  for (const ExperimentKind kind : {ExperimentKind::missions, ExperimentKind::maps, ExperimentKind::recognition,
                                    ExperimentKind::trials, ExperimentKind::homes}) {
    ExperimentConfig config;
    config.experiment = kind;
    config.missions = {"office.yaml"};
    config.variants = {{row.variant, {}}};
    config.baseline = row.variant;
    EXPECT_EQ(table_of(config, {again}), table_of(config, {row})) << name_of(kind);
    EXPECT_EQ(json_of(config, {again}), json_of(config, {row})) << name_of(kind);
  }
}

TEST(RowFile, WhatIsNoRowIsRefusedWithAReason) {
  const std::string text = row_text(measured_row(), "0123");
  EXPECT_THAT(refusal_of(text, "4567"), testing::HasSubstr("of another experiment"));
  EXPECT_EQ(refusal_of(text.substr(0, text.size() / 2)), "it is damaged");
  EXPECT_EQ(refusal_of("[]"), "it is damaged");
  EXPECT_EQ(refusal_of(""), "it is damaged");
  EXPECT_THAT(refusal_of(R"({"format": "cairn experiment row 3", "experiment": "0123", "row": [1, 2]})"),
              testing::HasSubstr("another number of values"));
}

}  // namespace
}  // namespace cairn
