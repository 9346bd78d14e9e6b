#include "framework/experiments/recognition/curves.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/experiments/recognition/curves_table.hpp"

namespace cairn {
namespace {

Detection detection(const std::string& category, double x_m, double degree) {
  return {category, {x_m, 0.0, 0.0}, degree, {}};
}

// A square at 1 m, a circle at 3 m, something else at 5 m.
Mission mission_of_three_things() {
  Mission mission;
  mission.world.emplace();
  for (const auto& [category, x_m] : {std::pair{"square", 1.0}, {"circle", 3.0}, {"", 5.0}}) {
    WorldObject object;
    object.category = category;
    object.T_map_object = {x_m, 0.0, 0.0};
    mission.world->objects.push_back(object);
  }
  mission.config.landmarks.merge_m = 0.4;
  return mission;
}

TEST(CountsOf, JudgesTheDetectionsOfEveryThreshold) {
  const std::vector<Detection> detections{detection("circle", 3.1, 0.5), detection("square", 1.1, 0.9),
                                          detection("square", 5.0, 0.7), detection("circle", 8.0, 0.7)};
  const WorldCounts counts = counts_of(detections, mission_of_three_things(), 0.3);
  EXPECT_EQ(counts.truly, 2);
  ASSERT_EQ(counts.counts.size(), 3U) << "two detections share the degree 0.7";
  EXPECT_EQ(counts.counts[0].found, 1);
  EXPECT_EQ(counts.counts[0].right, 1);
  EXPECT_EQ(counts.counts[1].found, 3);
  EXPECT_EQ(counts.counts[1].right, 1) << "something that is not a landmark, and nothing at all";
  EXPECT_EQ(counts.counts[2].found, 4);
  EXPECT_EQ(counts.counts[2].right, 2);
}

TEST(CountsOf, TheBestOfSeveralAtOnePlaceCounts) {
  const std::vector<Detection> detections{detection("circle", 1.1, 0.6), detection("square", 1.0, 0.8),
                                          detection("square", 1.2, 0.7)};
  const WorldCounts counts = counts_of(detections, mission_of_three_things(), 0.3);
  ASSERT_EQ(counts.counts.size(), 1U);
  EXPECT_EQ(counts.counts[0].found, 1);
  EXPECT_EQ(counts.counts[0].right, 1);
}

TEST(CurvesTable, HasARowForTheMissionAndForEachDetector) {
  ExperimentRow row;
  row.mission = "rooms";
  row.variant = "as_is";
  row.verdicts = {{"square", "square", 0.02, std::nullopt, 4.0}, {"circle", "", 0.0, std::nullopt, 0.0}};
  row.sweeps = {{"plain", {2, {{0.9, 1, 1}, {0.4, 2, 2}}}, 0.25}, {"blind", {2, {}}, 0.5}};
  ExperimentConfig config;
  config.experiment = ExperimentKind::curves;
  config.variants = {{"as_is", {}}};
  config.detectors = {{"plain", {}}, {"blind", {}}};
  const std::string table = curves_table(config, {row});
  EXPECT_THAT(table, testing::HasSubstr("| the mission itself | | 1.000 ("));
  EXPECT_THAT(table, testing::HasSubstr("| plain | 0.400 | 1.000 (")) << table;
  EXPECT_THAT(table, testing::HasSubstr("| blind | 0.000 | 0.000 (")) << table;
  EXPECT_THAT(table, testing::Not(testing::HasSubstr("250"))) << "no wall clock in what is repeatable";
  EXPECT_THAT(sweep_times_table(config, {row}), testing::HasSubstr("| plain | 250.0 |"));
}

}  // namespace
}  // namespace cairn
