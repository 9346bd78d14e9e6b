#include "framework/reporting/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

World world_with_square_at(double x_m, double y_m) {
  World world;
  WorldObject square;
  square.category = "square";
  square.T_map_object = {x_m, y_m, 0.0};
  world.objects.push_back(square);
  return world;
}

LandmarkGraph graph_with(const std::string& category, double x_m, double y_m) {
  LandmarkGraph graph;
  Landmark landmark;
  landmark.category = category;
  landmark.T_map_landmark = {x_m, y_m, 0.0};
  graph.add(landmark);
  return graph;
}

TEST(TruthScore, ALandmarkWithinTheToleranceIsFound) {
  const TruthScore score = score_against(world_with_square_at(1.0, 2.0), graph_with("square", 1.05, 2.0), 0.10);
  ASSERT_EQ(score.matched.size(), 1U);
  EXPECT_NEAR(score.matched[0].error_m, 0.05, 1e-12);
  EXPECT_EQ(score.false_landmarks, 0);
  EXPECT_EQ(score.missed_objects, 0);
}

TEST(TruthScore, AWrongCategoryIsBothFalseAndMissed) {
  const TruthScore score = score_against(world_with_square_at(1.0, 2.0), graph_with("circle", 1.0, 2.0), 0.10);
  EXPECT_EQ(score.false_landmarks, 1);
  EXPECT_EQ(score.missed_objects, 1);
}

TEST(TruthScore, AnObjectIsFoundOnlyOnce) {
  LandmarkGraph graph = graph_with("square", 1.0, 2.0);
  Landmark second;
  second.category = "square";
  second.T_map_landmark = {1.02, 2.0, 0.0};
  graph.add(second);
  const TruthScore score = score_against(world_with_square_at(1.0, 2.0), graph, 0.10);
  EXPECT_EQ(score.matched.size(), 1U);
  EXPECT_EQ(score.false_landmarks, 1);
}

TEST(TruthScore, ObstaclesWithoutCategoryAreNotMissed) {
  World world = world_with_square_at(1.0, 2.0);
  world.objects.push_back({});
  EXPECT_EQ(score_against(world, graph_with("square", 1.0, 2.0), 0.10).missed_objects, 0);
}

TEST(RunReport, ListsTheContactsThatTheSimulationJudged) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  Observation observation;
  observation.bumped = true;
  WorldView world{grid, graph, robot, {}, 12.5, &observation};
  RunReport report;
  report.on(Bumped{}, {world});  // of a log
  MissionView view{world};
  view.truth = GroundTruth{{}, Contact{0.25, true}};
  report.on(Bumped{}, view);
  ASSERT_EQ(report.contacts().size(), 1U);
  MissionResult result;
  result.collisions = 2;
  const std::string text = report.report_json({}, result, graph, {});
  const std::size_t at = text.find("\"contacts\"");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(text.substr(at, text.find(']', at) - at + 1),
            "\"contacts\": [\n    {\n      \"time_s\": 12.5,\n      \"speed_mps\": 0.25,\n      "
            "\"could_be_seen\": true\n    }\n  ]");
}

TEST(RunReport, SaysHowManyLoopsClosedAndHowOftenTheMapMoved) {
  const LandmarkGraph graph;
  MissionResult result;
  const std::string without = RunReport().report_json({}, result, graph, {});
  EXPECT_THAT(without, testing::Not(testing::HasSubstr("pose_graph")));
  EXPECT_THAT(without, testing::Not(testing::HasSubstr("map_moves")));
  result.pose_graph = SubmapCounts{30, 4, 50, 7, 6};
  result.map_moves = 2;
  const std::string with = RunReport().report_json({}, result, graph, {});
  EXPECT_THAT(with, testing::HasSubstr("\"closures\": 7,\n    \"closures_believed\": 6\n"));
  EXPECT_THAT(with, testing::HasSubstr("\"map_moves\": 2"));
}

TEST(RunReport, ListsWhenTheRobotWasHeldAndByWhom) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  Observation observation;
  RunReport report;
  for (int second = 0; second < 6; ++second) {
    observation.stopped_by = second == 2 || second == 3 ? "the emergency topic /e_stop" : "";
    const WorldView world{grid, graph, robot, {}, static_cast<double>(second), &observation};
    if (second == 2) report.on(RobotStopped{observation.stopped_by}, {world});
    report.on(TickDone{}, {world});
  }
  const std::string text = report.report_json({}, {}, graph, {});
  EXPECT_THAT(text, testing::HasSubstr("\"holds\": [\n    {\n      \"begin_s\": 2.0,\n      \"end_s\": 4.0\n"));
  EXPECT_THAT(text, testing::HasSubstr("2.00 s: the robot is stopped by the emergency topic /e_stop"));
}

class RunReportOfALongMission : public testing::Test {
 protected:
  // Per second of mission time a tick, a matching, a contact and a message.
  std::string report_after(int seconds, const HistoryConfig& history) {
    RunReport report(history);
    Observation observation;
    for (int i = 0; i < seconds; ++i) {
      const WorldView world{grid_, graph_, robot_, {}, static_cast<double>(i), &observation};
      MissionView view{world};
      view.truth = GroundTruth{{}, Contact{0.25, true}};
      report.on(TickDone{}, view);
      Matching matching;
      matching.degrees = {{"square", 0.5, 0.0, {}, true}, {"circle", 0.4, 0.0, {}, true}};
      report.on(MatchingDone{matching}, view);
      report.on(Bumped{}, view);
      report.on(Message{"round " + std::to_string(i)}, view);
    }
    return report.report_json({}, {}, graph_, {});
  }

  const OccupancyGrid grid_{0.05};
  const LandmarkGraph graph_{};
  const RobotModel robot_{};
};

TEST_F(RunReportOfALongMission, HasABoundedSize) {
  const HistoryConfig history{.max_path_poses = 1000, .max_samples = 200, .max_events = 200};
  const std::string hour = report_after(3600, history);
  const std::string day = report_after(86400, history);
  EXPECT_LT(hour.size(), 120'000U);
  EXPECT_LT(day.size(), 120'000U);
  EXPECT_NE(day.find(": round 0\""), std::string::npos);
  EXPECT_NE(day.find(": round 86399\""), std::string::npos) << "how it ended is there";
  EXPECT_NE(day.find("\"degrees_every\": 512"), std::string::npos);
  EXPECT_NE(day.find("\"events_left_out\": 172600"), std::string::npos);
}

TEST_F(RunReportOfALongMission, UpToTheBoundsIsWhole) {
  const std::string bounded = report_after(190, {.max_samples = 200, .max_events = 400});
  EXPECT_EQ(bounded, report_after(190, {}));
  EXPECT_EQ(bounded.find("degrees_every"), std::string::npos);
  EXPECT_EQ(bounded.find("events_left_out"), std::string::npos);
}

}  // namespace
}  // namespace cairn
