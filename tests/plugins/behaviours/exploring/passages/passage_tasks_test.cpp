#include "plugins/behaviours/exploring/passages/passage_tasks.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

// Cells of 0.1 m; what is behind the doorway is not known. width: of the doorway, in cells.
std::string room(int width) {
  std::string drawing = "\n############\n";
  for (int y = 0; y < 10; ++y) {
    const bool is_door = y >= 4 && y < 4 + width;
    drawing += std::string(y == 5 ? "#..R......." : "#..........") + (is_door ? "." : "#") + "\n";
  }
  return drawing + "############\n";
}

struct Passing {
  explicit Passing(int width) : map(room(width)) {}
  [[nodiscard]] FreeSpace space() const { return FreeSpace(map.grid, {robot().position(), 0.2, 0.1}, trace()); }
  [[nodiscard]] Pose2 robot() const { return {map.at('R').x(), map.at('R').y(), 0.0}; }
  [[nodiscard]] std::vector<Pose2> trace() const { return {robot()}; }
  std::optional<ExploreTask> next() {
    const std::vector<Pose2> been = trace();
    return tasks.next(space(), {map.grid, been, looked_at}, robot().position());
  }
  std::vector<NotEntered> not_entered() {
    const std::vector<Pose2> been = trace();
    return tasks.not_entered(space(), {map.grid, been, looked_at}, 0.2);
  }
  AsciiGrid map;
  PassageTasks tasks{PassageSettings{}};
  std::vector<Point> looked_at;
};

TEST(PassageTasks, APassageIsLookedAtThenDrivenThrough) {
  Passing passing(5);
  std::optional<ExploreTask> task = passing.next();
  ASSERT_TRUE(task);
  EXPECT_EQ(task->kind, TaskKind::opening);
  EXPECT_FALSE(task->path.empty());
  passing.looked_at.push_back(task->about);
  task = passing.next();
  ASSERT_TRUE(task);
  EXPECT_EQ(task->kind, TaskKind::passage);
  EXPECT_TRUE(task->by_route);
  EXPECT_GT(task->lookout.x(), task->about.x());
}

TEST(PassageTasks, OneThatWasNotGotThroughIsTriedOnceMoreAndLookedAtAgain) {
  Passing passing(5);
  passing.looked_at.push_back(passing.next()->about);
  passing.tasks.record(*passing.next(), false, "the robot is blocked");
  EXPECT_FALSE(passing.next());
  EXPECT_TRUE(passing.tasks.retry(passing.looked_at));
  EXPECT_TRUE(passing.looked_at.empty());
  EXPECT_EQ(passing.next()->kind, TaskKind::opening);
  EXPECT_FALSE(passing.tasks.retry(passing.looked_at)) << "once only";
}

TEST(PassageTasks, OneThatWasNotGotThroughIsReportedWithItsPlaceWidthAndReason) {
  Passing passing(5);
  passing.looked_at.push_back(passing.next()->about);
  passing.tasks.record(*passing.next(), false, "the robot is blocked");
  const std::vector<NotEntered> left = passing.not_entered();
  ASSERT_EQ(left.size(), 1U);
  EXPECT_FALSE(left[0].is_too_narrow);
  EXPECT_EQ(left[0].why, "the robot is blocked");
  EXPECT_NEAR(left[0].width_m, 0.5, 0.15);
}

TEST(PassageTasks, OneThatWasNeverTriedIsReportedAsThat) {
  const std::vector<NotEntered> left = Passing(5).not_entered();
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].why, "not tried");
}

TEST(PassageTasks, ANarrowGapIsLookedAtAndReportedAsTooNarrow) {
  Passing passing(2);
  PassageSettings settings;
  settings.drive_radius_m = 0.16;
  passing.tasks = PassageTasks(settings);
  std::optional<ExploreTask> task = passing.next();
  ASSERT_TRUE(task);
  passing.looked_at.push_back(task->about);
  EXPECT_FALSE(passing.next());
  const std::vector<NotEntered> left = passing.not_entered();
  ASSERT_EQ(left.size(), 1U);
  EXPECT_TRUE(left[0].is_too_narrow);
  EXPECT_EQ(left[0].why, "too narrow for 0.40 m");
}

TEST(PassageTasks, ASentenceNamesThePlaceTheWidthAndTheReason) {
  EXPECT_EQ(sentence_of(NotEntered{{2.4, 4.0}, 0.4, true, "too narrow for 0.44 m"}),
            "opening at (2.40, 4.00), 0.40 m wide: too narrow for 0.44 m");
}

}  // namespace
}  // namespace cairn::behaviours
