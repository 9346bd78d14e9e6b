#include "plugins/behaviours/exploring/task_chooser.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

// One end of a room is not known.
struct Choosing : testing::Test {
  Choosing()
      : map(R"(
##################################
#........................         
#........................         
#........................         
#....R...................         
#........................         
#........................         
#........................         
##################################
)") {
    robot.radius_m = 0.2;
    config.look_closer_m = 0.0;
    T_map_robot = {map.at('R').x(), map.at('R').y(), radians(180.0)};
  }
  [[nodiscard]] WorldView world() const {
    WorldView view{map.grid, graph, robot, {}, 10.0, nullptr};
    view.pose.T_map_robot = T_map_robot;
    return view;
  }
  [[nodiscard]] TaskChooser chooser() const {
    TaskChooser made(config, world());
    made.begin_here(world());
    made.see(world());
    return made;
  }
  AsciiGrid map;
  LandmarkGraph graph;
  RobotModel robot;
  ExploreConfig config;
  Pose2 T_map_robot;
};

TEST_F(Choosing, AFrontierWhereTheMapEnds) {
  const std::optional<ExploreTask> task = chooser().choose(world(), std::nullopt);
  ASSERT_TRUE(task);
  EXPECT_EQ(task->kind, TaskKind::frontier);
  EXPECT_NEAR(task->about.x(), 2.45, 0.11);
}

TEST_F(Choosing, NoFrontierWhereOnlyThePartOfTheMapEndsThatIsSearchedFirst) {
  std::string closed = "\n##################################\n";
  for (int y = 0; y < 7; ++y)
    closed += y == 3 ? "#...............................R#\n" : "#................................#\n";
  map = AsciiGrid(closed + "##################################\n");
  T_map_robot = {map.at('R').x() - 0.3, map.at('R').y(), 0.0};
  config.until_known_ratio = 1.0;
  config.exploring.choice.around_m = 2.0;
  EXPECT_FALSE(chooser().choose(world(), std::nullopt));
}

TEST_F(Choosing, NothingOnceTheFrontierIsGivenUp) {
  TaskChooser chooser = this->chooser();
  for (int i = 0; i < 20; ++i) {
    const std::optional<ExploreTask> task = chooser.choose(world(), std::nullopt);
    if (!task) return;
    chooser.give_up(*task, world());
  }
  FAIL() << "it chooses what was given up again and again";
}

// The map and all in it lie a metre further.
TEST_F(Choosing, WhatWasGivenUpMovesWithTheMap) {
  TaskChooser chooser = this->chooser();
  while (const auto task = chooser.choose(world(), std::nullopt)) chooser.give_up(*task, world());
  const Pose2 before = std::exchange(T_map_robot, Pose2{1.0, 1.0, 0.0} * T_map_robot);
  const OccupancyGrid grid = std::exchange(map.grid, OccupancyGrid(map.grid.cell_m()));
  const CellBox box = grid.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (grid.state({x, y}) != CellState::unknown)
        map.grid.set_log_odds(map.grid.cell_at(grid.centre_of({x, y}) + Point(1.0, 1.0)), grid.log_odds({x, y}));
  const MapMove move({before}, {T_map_robot});
  for (const MapMove* const known : {&move, static_cast<const MapMove*>(nullptr)}) {
    chooser.begin_in_new_map(world(), known);
    chooser.begin_here(world());
    chooser.see(world());
    EXPECT_EQ(chooser.choose(world(), std::nullopt).has_value(), known == nullptr) << "else all is forgotten";
  }
}

TEST_F(Choosing, APathIsBlockedWhenSomethingTurnsUpOnIt) {
  TaskChooser chooser = this->chooser();
  const std::optional<ExploreTask> task = chooser.choose(world(), std::nullopt);
  ASSERT_TRUE(task);
  const std::vector<Point> path{map.at('R'), map.at('R') + Point(0.5, 0.0)};
  EXPECT_FALSE(chooser.is_blocked(world(), path, 0.0));
  map.grid.set_log_odds(map.grid.cell_at(path.back()), 600);
  EXPECT_TRUE(chooser.is_blocked(world(), path, 0.0));
}

TEST_F(Choosing, ARobotThatCannotGoBackIsShutIn) {
  TaskChooser chooser = this->chooser();
  EXPECT_FALSE(chooser.is_shut_in(world()));
  for (int y = 1; y < 8; ++y) map.grid.set_log_odds({12, y}, 600);
  T_map_robot.x_m += 1.3;
  chooser.see(world());
  EXPECT_TRUE(chooser.is_shut_in(world()));
}

}  // namespace
}  // namespace cairn::behaviours
