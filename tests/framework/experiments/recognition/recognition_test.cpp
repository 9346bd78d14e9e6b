#include "framework/experiments/recognition/recognition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/experiments/recognition/recognition_table.hpp"
#include "framework/experiments/report.hpp"

namespace cairn {
namespace {

void put(World& world, const std::string& category, const Pose2& at) {
  WorldObject object;
  object.category = category;
  object.T_map_object = at;
  world.objects.push_back(object);
}

void find(LandmarkGraph& graph, const std::string& category, const Pose2& at) {
  Landmark landmark;
  landmark.category = category;
  landmark.T_map_landmark = at;
  graph.add(landmark);
}

Mission mission_with_two_shapes() {
  Mission mission;
  mission.world.emplace();
  mission.shapes = {{"circle", Contour::circle(0.5)},
                    {"square", Contour::polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}})}};
  return mission;
}

TEST(JudgeRecognition, PairsTheNearestAndReportsTheRest) {
  Mission mission = mission_with_two_shapes();
  put(*mission.world, "square", {1.0, 1.0, radians(10.0)});
  put(*mission.world, "circle", {3.0, 1.0, 0.0});
  put(*mission.world, "", {5.0, 1.0, 0.0});
  LandmarkGraph graph;
  find(graph, "circle", {1.2, 1.0, 0.0});  // farther from the square than the next one: nothing is there
  find(graph, "square", {1.0, 1.1, radians(95.0)});
  find(graph, "circle", {5.1, 1.0, 0.0});
  const auto verdicts = judge_recognition(mission, graph, FirstKnown{}, 0.3);
  ASSERT_EQ(verdicts.size(), 4U);
  EXPECT_TRUE(verdicts[0].is_right());
  EXPECT_NEAR(verdicts[0].position_error_m, 0.1, 1e-12);
  EXPECT_NEAR(degrees(*verdicts[0].orientation_error_rad), 5.0, 1e-9) << "a square repeats after 90 deg";
  EXPECT_EQ(verdicts[1].found, "");
  EXPECT_EQ(verdicts[2].found, "circle") << "a thing that is not a landmark";
  EXPECT_FALSE(verdicts[2].is_right());
  EXPECT_EQ(verdicts[3].found, "circle");
  EXPECT_EQ(verdicts[3].is, "");
}

TEST(JudgeRecognition, ACircleHasNoOrientation) {
  Mission mission = mission_with_two_shapes();
  put(*mission.world, "circle", {3.0, 1.0, 1.0});
  LandmarkGraph graph;
  find(graph, "circle", {3.0, 1.0, 0.0});
  EXPECT_FALSE(judge_recognition(mission, graph, FirstKnown{}, 0.3)[0].orientation_error_rad.has_value());
}

TEST(RecognitionFigures, CountByHand) {
  ExperimentRow row;
  row.mission = "rooms";
  row.variant = "as_is";
  row.verdicts = {{"square", "square", 0.02, radians(20.0), 4.0},
                  {"square", "square", 0.04, radians(1.0), 6.0},
                  {"circle", "square", 0.01, std::nullopt, 9.0},
                  {"circle", "", 0.0, std::nullopt, 0.0},
                  {"", "circle", 0.0, std::nullopt, 9.0}};
  const RecognitionFigures figures = recognition_figures({&row}, radians(15.0));
  EXPECT_DOUBLE_EQ(figures.precision.value, 2.0 / 4.0);
  EXPECT_DOUBLE_EQ(figures.recall.value, 2.0 / 4.0);
  EXPECT_DOUBLE_EQ(figures.f1.value, 0.5);
  EXPECT_DOUBLE_EQ(figures.right_category.value, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(figures.median_error_m.value, 0.03);
  EXPECT_DOUBLE_EQ(figures.within_step.value, 0.5);
  EXPECT_DOUBLE_EQ(figures.driven_m.mean, 5.0);
  ExperimentConfig config;
  config.experiment = ExperimentKind::recognition;
  config.variants = {{"as_is", {}}};
  EXPECT_THAT(recognition_table(config, {row}), testing::HasSubstr("| circle | 1 | 0 | 1 |")) << "none, circle, square";
}

ExperimentRow row_of(const std::string& variant, std::int64_t seed, std::int64_t matchings,
                     const std::vector<Verdict>& verdicts) {
  ExperimentRow row;
  row.mission = "rooms";
  row.variant = variant;
  row.seed = seed;
  row.result.distance_m = 10.0;
  row.result.matchings = matchings;
  row.verdicts = verdicts;
  return row;
}

TEST(BaselineFigures, CompareTheSameWorldsByHand) {
  const Verdict square{"square", "square", 0.0, std::nullopt, 1.0};
  const Verdict missed{"square", "", 0.0, std::nullopt, 0.0};
  const Verdict false_one{"", "circle", 0.0, std::nullopt, 1.0};
  std::vector<ExperimentRow> rows = {row_of("every_update", 1, 300, {square, square, missed, false_one}),
                                     row_of("every_update", 2, 100, {square, square}),
                                     row_of("gated", 2, 5, {square, square, false_one}),
                                     row_of("gated", 1, 15, {square, missed, square}), row_of("gated", 3, 999, {})};
  rows[2].result.distance_m = 11.0;
  const BaselineFigures figures =
      baseline_figures(rows_of(rows, "rooms", "gated"), rows_of(rows, "rooms", "every_update"));
  EXPECT_EQ(figures.worlds, 2);
  EXPECT_EQ(figures.same_drives, 1);
  EXPECT_DOUBLE_EQ(figures.matchings.value, 20.0);
  EXPECT_DOUBLE_EQ(figures.lost.value, 1.0 / 4.0) << "what only the variant finds does not make up for it";
  ExperimentConfig config;
  config.experiment = ExperimentKind::recognition;
  config.variants = {{"gated", {}}, {"every_update", {}}};
  EXPECT_THAT(recognition_table(config, rows), testing::Not(testing::HasSubstr("Against")));
  config.baseline = "every_update";
  EXPECT_THAT(recognition_table(config, rows), testing::HasSubstr("\n| gated | 1 of 2 | 20.0 (20.0 - 20.0) | 0.250"));
}

}  // namespace
}  // namespace cairn
