#include "plugins/behaviours/exploring/explore_tasks.hpp"

#include <gmock/gmock.h>

#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

using testing::IsEmpty;
using testing::Not;

// 3 x 2 m. In the right wall is a gap of so many cells, behind which nothing is known.
AsciiGrid room_with_gap(int gap_cells) {
  std::string drawing;
  for (int r = 0; r < 20; ++r) {
    std::string row(30, r == 0 || r == 19 ? '#' : '.');
    row.front() = '#';
    row.back() = r >= 6 && r < 6 + gap_cells ? ' ' : '#';
    if (r == 10) row[5] = 'R';
    drawing += row + "\n";
  }
  return AsciiGrid(drawing);
}

FreeSpace space_of(const AsciiGrid& map) {
  return FreeSpace(map.grid, {map.at('R'), 0.2, 0.1}, {{map.at('R').x(), map.at('R').y(), 0.0}});
}

// Without orbits and edges.
TaskSettings frontiers_only() {
  TaskSettings settings;
  settings.orbit.look_closer_m = 0.0;
  return settings;
}

std::optional<ExploreTask> task_in(const AsciiGrid& map, ExploreMemory& memory, bool frontiers_wanted = true) {
  const Point at = map.at('R');
  return next_task(space_of(map), {at.x(), at.y(), 0.0}, frontiers_wanted, nullptr, frontiers_only(), memory);
}

TEST(ExploreTasks, NothingIsLeftInAClosedRoomThatIsKnown) {
  ExploreMemory memory;
  EXPECT_FALSE(task_in(room_with_gap(0), memory));
}

TEST(ExploreTasks, TheFrontierInAGapIsNextWithAPathToIt) {
  const AsciiGrid map = room_with_gap(8);
  ExploreMemory memory;
  const auto task = task_in(map, memory);
  ASSERT_TRUE(task);
  EXPECT_EQ(task->kind, TaskKind::frontier);
  EXPECT_THAT(task->targets, Not(IsEmpty()));
  EXPECT_GT(task->about.x(), 2.5);
  ASSERT_THAT(task->path, Not(IsEmpty()));
  EXPECT_EQ(task->path.back(), task->lookout);
  EXPECT_GT(task->cost_m, 0.0);
}

TEST(ExploreTasks, NoFrontierIsOfferedWhereNoneIsWanted) {
  ExploreMemory memory;
  EXPECT_FALSE(task_in(room_with_gap(8), memory, false));
}

TEST(ExploreTasks, AGapThatTheRobotDoesNotFitThroughIsNoFrontier) {
  const AsciiGrid map = room_with_gap(3);
  ExploreMemory memory;
  EXPECT_TRUE(task_in(map, memory)) << "the small robot fits";
  const Pose2 at{map.at('R').x(), map.at('R').y(), 0.0};
  const FreeSpace for_large(map.grid, {map.at('R'), 0.3, 0.1}, {at});
  EXPECT_FALSE(next_task(for_large, at, true, nullptr, frontiers_only(), memory));
}

TEST(ExploreTasks, AFrontierThatWasGivenUpIsNotChosenAgain) {
  const AsciiGrid map = room_with_gap(8);
  ExploreMemory memory;
  const auto task = task_in(map, memory);
  ASSERT_TRUE(task);
  give_up(*task, space_of(map), frontiers_only(), memory);
  EXPECT_FALSE(task_in(map, memory));
}

TEST(ExploreTasks, OrbitsAndOpeningsAreGivenUpByTheirPlaces) {
  const AsciiGrid map = room_with_gap(0);
  ExploreMemory memory;
  ExploreTask task;
  task.lookout = {1.0, 1.0};
  task.about = {2.0, 1.0};
  task.kind = TaskKind::orbit;
  give_up(task, space_of(map), frontiers_only(), memory);
  task.kind = TaskKind::opening;
  give_up(task, space_of(map), frontiers_only(), memory);
  EXPECT_THAT(memory.given_up_lookouts, testing::ElementsAre(task.lookout));
  EXPECT_THAT(memory.seen_openings, testing::ElementsAre(task.about));
}

TEST(ExploreTasks, AFrontierIsWorthwhileUntilWhatLiesBehindIsKnown) {
  AsciiGrid map = room_with_gap(8);
  ExploreMemory memory;
  const auto task = task_in(map, memory);
  ASSERT_TRUE(task);
  EXPECT_TRUE(still_worthwhile(*task, map.grid, frontiers_only().weights));
  for (int y = -1; y <= 20; ++y) map.grid.set_log_odds({29, y}, LogOdds{-600});
  EXPECT_FALSE(still_worthwhile(*task, map.grid, frontiers_only().weights));
}

TEST(ExploreTasks, ASentenceSaysWhatIsDoneWhere) {
  ExploreTask task;
  task.about = {1.0, 2.5};
  EXPECT_EQ(sentence_of(task), "going to the frontier at (1.00, 2.50)");
  task.kind = TaskKind::orbit;
  EXPECT_EQ(sentence_of(task), "going round the object at (1.00, 2.50)");
  task.kind = TaskKind::edge;
  EXPECT_EQ(sentence_of(task), "looking closer at the edge at (1.00, 2.50)");
  task.kind = TaskKind::opening;
  EXPECT_EQ(sentence_of(task), "looking into the narrow opening at (1.00, 2.50)");
}

}  // namespace
}  // namespace cairn::behaviours
