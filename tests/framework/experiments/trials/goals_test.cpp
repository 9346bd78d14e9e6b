#include "framework/experiments/trials/goals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

// A room of 6 x 4 m with a square at (4, 2); the robot begins at (1, 1).
struct Trial {
  Trial() {
    mission.config.start.at_m = {1.0, 1.0};
    mission.world.emplace();
    World& world = *mission.world;
    world.max_m = {6.0, 4.0};
    world.walls = {{{{0, 0}, {6, 0}, {6, 4}, {0, 4}, {0, 0}}}};
    WorldObject square;
    square.category = "square";
    square.contour = Contour::polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}});
    square.T_map_object = {4.0, 2.0, 0.0};
    world.objects = {square};
    const CellBox all = {grid.cell_at({0.01, 0.01}), grid.cell_at({5.99, 3.99})};
    for (int y = all.min.y; y <= all.max.y; ++y)
      for (int x = all.min.x; x <= all.max.x; ++x) grid.set_log_odds({x, y}, -500);
  }

  void steps(const std::string& list) {
    MissionTree tree = read_mission_tree(parse_config_text("steps: " + list, "m.yaml").find("steps")[0], "m.yaml");
    ASSERT_TRUE(tree.errors.empty());
    mission.steps = std::move(tree.steps);
  }
  void fault(const std::string& list) { mission.config.sensor.config = parse_config_text("faults: " + list, "m.yaml"); }
  // The leaf ran and ended so.
  void ran(const std::string& path, double begin_s, double end_s, StepState how, bool halted = false) {
    NodeReport report;
    report.path = path;
    report.status = {how, "as it was"};
    report.is_halted = halted;
    report.end_s = end_s;
    TreeNode node;
    node.path = path;
    result.node_runs.add(node, report, begin_s);
    result.nodes.push_back(report);
  }
  // The robot's true path, a tick a second, and how far off its estimate is.
  void drive(const std::vector<Point>& way, double off_m = 0.0) {
    for (const Point& at : way) {
      Observation observation;
      WorldView world{grid, graph, mission.robot, {}, time_s, &observation};
      world.pose.T_map_robot = {at.x() + off_m, at.y(), 0.0};
      MissionView view{world};
      view.truth = GroundTruth{{at.x(), at.y(), 0.0}};
      record.on(TickDone{}, view);
      time_s += 1.0;
    }
  }
  // Given the first ones, with the landmarks that there are now.
  void end_steps(int count) {
    const WorldView world{grid, graph, mission.robot, {}, time_s, nullptr};
    for (int i = 0; i < count; ++i) record.on(StepEnded{i, "", {}}, {world});
  }
  [[nodiscard]] std::vector<GoalVerdict> judge() const {
    return judge_goals(TrialsConfig{}, {mission, result, record, &grid});
  }

  Mission mission;
  MissionResult result;
  TrialRecord record;
  OccupancyGrid grid{0.05};
  LandmarkGraph graph;
  double time_s = 0.0;
};

TEST(TrialGoals, ASuccessCountsOnlyWhereTheRobotTrulyIs) {
  Trial trial;
  trial.steps("[{goto: {at_m: [3, 1]}}, {goto: {at_m: [3, 3]}}]");
  trial.drive({{1, 1}, {2, 1}, {3.3, 1}, {3, 1.5}, {3, 2.5}});
  trial.ran("1", 0.0, 2.0, StepState::success);
  trial.ran("2", 2.0, 4.0, StepState::success);
  const auto goals = trial.judge();
  ASSERT_EQ(goals.size(), 2U);
  EXPECT_EQ(goals[0].goal, "goto (3.00, 1.00)");
  EXPECT_EQ(goals[0].end, GoalEnd::reached) << "0.3 m off, allowed are 0.3 and the tolerance of 0.1";
  EXPECT_EQ(goals[1].end, GoalEnd::false_success);
  EXPECT_NEAR(goals[1].missed_m, 0.1, 1e-9);
  EXPECT_TRUE(goals[1].is_reachable);
  EXPECT_TRUE(goals[1].is_mapped);
}

TEST(TrialGoals, ALeafThatRanAgainEndsAsTheLastTime) {
  Trial trial;
  trial.steps("[{retry: {times: 2, do: {goto: {at_m: [3, 1]}}}}, {goto: {at_m: [5, 1]}}]");
  trial.drive({{1, 1}, {2, 1}, {3, 1}});
  trial.ran("1/1", 0.0, 1.0, StepState::failure);
  trial.ran("1/1", 1.0, 2.0, StepState::success);
  const auto goals = trial.judge();
  ASSERT_EQ(goals.size(), 1U) << "the second goal was never begun";
  EXPECT_EQ(goals[0].end, GoalEnd::reached);
  EXPECT_DOUBLE_EQ(goals[0].begin_s, 0.0);
}

TEST(TrialGoals, FailedAndHaltedOnesAreMissed) {
  Trial trial;
  trial.steps("[{goto: {at_m: [3, 1]}}, {goto: {at_m: [3, 1]}}]");
  trial.drive({{1, 1}, {2, 1}, {2, 1}});
  trial.ran("1", 0.0, 1.0, StepState::failure);
  trial.ran("2", 1.0, 2.0, StepState::failure, true);
  const auto goals = trial.judge();
  EXPECT_EQ(goals[0].end, GoalEnd::failed);
  EXPECT_EQ(goals[0].reason, "as it was");
  EXPECT_EQ(goals[1].end, GoalEnd::halted);
}

TEST(TrialGoals, WithoutRoomOrWayAGoalIsNotReachable) {
  Trial trial;
  WorldDoor door;
  door.from_m = {3.0, 0.0};
  door.to_m = {3.0, 4.0};
  door.closed_s = {{0.0, 5.0}};
  trial.mission.world->doors = {door};
  trial.steps("[{goto: {at_m: [4, 2]}}, {goto: {at_m: [0.3, 1]}}, {goto: {at_m: [5, 1]}}, {goto: {at_m: [5, 1]}}]");
  trial.drive(std::vector<Point>(10, Point(1, 1)));
  trial.ran("1", 0.0, 9.0, StepState::failure);
  trial.ran("2", 0.0, 9.0, StepState::failure);
  trial.ran("3", 0.0, 4.0, StepState::failure);
  trial.ran("4", 0.0, 6.0, StepState::failure);
  const auto goals = trial.judge();
  EXPECT_FALSE(goals[0].is_reachable) << "in the square";
  EXPECT_FALSE(goals[1].is_reachable) << "less than the radius and 0.12 m from the wall";
  EXPECT_FALSE(goals[2].is_reachable) << "behind a door that was shut all the time";
  EXPECT_TRUE(goals[3].is_reachable) << "behind a door that opened in the end";
}

TEST(TrialGoals, FaultsStrikeWhileTheyLastAndDisplaceUntilTheEstimateIsRight) {
  Trial trial;
  trial.fault("[{at_s: 2, for_s: 1, dead: [0]}, {at_s: 5.5, kidnap: {to_m: [1, 1]}}]");
  trial.steps("[{goto: {at_m: [3, 1]}}, {goto: {at_m: [3, 1]}}, {goto: {at_m: [3, 1]}}, {goto: {at_m: [3, 1]}}]");
  trial.drive(std::vector<Point>(5, Point(3, 1)), 0.5);
  trial.drive(std::vector<Point>(3, Point(3, 1)), 0.5);
  trial.drive(std::vector<Point>(3, Point(3, 1)), 0.2);
  trial.ran("1", 0.0, 1.0, StepState::success);
  trial.ran("2", 2.5, 4.0, StepState::success);
  trial.ran("3", 6.0, 7.0, StepState::success);
  trial.ran("4", 8.0, 10.0, StepState::success);
  const auto goals = trial.judge();
  EXPECT_FALSE(goals[0].is_struck || goals[0].is_displaced) << "off by itself: no fault's fault";
  EXPECT_TRUE(goals[1].is_struck);
  EXPECT_FALSE(goals[1].is_displaced) << "a dead transducer moves no estimate";
  EXPECT_FALSE(goals[2].is_struck) << "a kidnapping is over at once";
  EXPECT_TRUE(goals[2].is_displaced);
  EXPECT_FALSE(goals[3].is_struck || goals[3].is_displaced) << "it has found back";
}

TEST(TrialGoals, ATourMustHaveBeenEverywhere) {
  Trial trial;
  trial.steps("[{tour: {places: [[3, 1], [1, 3]]}}, {patrol: {rounds: 1, places: [[3, 1], [5, 3]]}}, return_home]");
  trial.drive({{1, 1}, {3, 1}, {1, 3}, {1, 1.2}});
  trial.ran("1", 0.0, 2.0, StepState::success);
  trial.ran("2", 0.0, 3.0, StepState::success);
  trial.ran("3", 2.0, 3.0, StepState::success);
  const auto goals = trial.judge();
  ASSERT_EQ(goals.size(), 3U);
  EXPECT_EQ(goals[0].end, GoalEnd::reached);
  EXPECT_EQ(goals[1].end, GoalEnd::false_success);
  EXPECT_EQ(goals[2].end, GoalEnd::reached) << "home is where it began";
}

TEST(TrialGoals, ALandmarkIsReachedWhereTheMapSaysToStandIfItIsTrue) {
  Trial trial;
  trial.steps("[{goto: nearest square}, {goto: {landmark: nearest square}}, {goto: nearest circle}]");
  trial.drive({{1, 1}, {3.3, 2.0}, {2.5, 2.0}});
  trial.ran("1", 0.0, 1.0, StepState::success);
  trial.ran("2", 1.0, 2.0, StepState::success);
  trial.ran("3", 1.0, 2.0, StepState::failure);
  EXPECT_FALSE(trial.judge()[0].is_mapped);
  EXPECT_EQ(trial.judge()[0].end, GoalEnd::false_success) << "the map held none";
  Landmark landmark;
  landmark.category = "square";
  landmark.T_map_landmark = {4.1, 2.0, 0.0};
  landmark.access = Pose2{3.1, 2.0, 0.0};
  const LandmarkId id = trial.graph.add(landmark);
  trial.end_steps(2);
  const auto goals = trial.judge();
  EXPECT_TRUE(goals[0].is_mapped);
  EXPECT_EQ(goals[0].end, GoalEnd::reached);
  EXPECT_EQ(goals[1].end, GoalEnd::false_success) << "0.6 m from where one stands";
  EXPECT_TRUE(goals[0].is_reachable);
  EXPECT_FALSE(goals[2].is_reachable) << "there is no circle";
  trial.graph.find(id)->access = Pose2{4.0, 3.0, 0.0};
  trial.end_steps(2);
  EXPECT_EQ(trial.judge()[0].end, GoalEnd::reached) << "beside its outline, elsewhere than the map says";
  EXPECT_EQ(trial.judge()[1].end, GoalEnd::false_success);
  trial.graph.find(id)->T_map_landmark = {1.0, 2.0, 0.0};
  trial.end_steps(2);
  EXPECT_EQ(trial.judge()[0].end, GoalEnd::false_success) << "no square is there";
}

TEST(TrialGoals, APlaceThatTheMapDoesNotKnowWasNeverExplored) {
  Trial trial;
  trial.grid = OccupancyGrid(0.05);
  trial.steps("[{goto: {at_m: [3, 1]}}]");
  trial.drive({{1, 1}, {1, 1}});
  trial.ran("1", 0.0, 1.0, StepState::failure);
  EXPECT_FALSE(trial.judge()[0].is_mapped);
}

}  // namespace
}  // namespace cairn
