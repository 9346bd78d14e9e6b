#include "plugins/behaviours/exploring/passages/passage_tasks.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kRadius_m = 0.2;

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
  explicit Passing(int width) : map(room(width)), trace{{map.at('R').x(), map.at('R').y(), 0.0}} {}
  [[nodiscard]] FreeSpace space() const { return FreeSpace(map.grid, {trace[0].position(), kRadius_m, 0.1}, trace); }
  std::optional<ExploreTask> next() {
    const FreeSpace here = space();
    return tasks.next({here, here, map.grid, trace, kRadius_m}, trace[0].position());
  }
  std::vector<NotEntered> not_entered() {
    const FreeSpace here = space();
    return tasks.not_entered({here, here, map.grid, trace, kRadius_m});
  }
  // A look from the lookout, in which so much was heard to be open.
  std::optional<ExploreTask> look(double heard_m) {
    const std::optional<ExploreTask> task = next();
    return tasks.record_look(*task, HeardOpening{true, heard_m, task->about, task->lookout}, kRadius_m);
  }
  AsciiGrid map;
  std::vector<Pose2> trace;
  PassageTasks tasks{PassageSettings{}, PassageDriveSettings{}};
};

TEST(PassageTasks, APassageIsLookedAtFirst) {
  const std::optional<ExploreTask> task = Passing(5).next();
  ASSERT_TRUE(task);
  EXPECT_EQ(task->kind, TaskKind::opening);
  EXPECT_FALSE(task->path.empty());
}

TEST(PassageTasks, AfterTheLookTheDriveLeadsStraightThroughTheMiddleThatWasHeard) {
  Passing passing(5);
  const std::optional<ExploreTask> drive = passing.look(0.7);
  ASSERT_TRUE(drive);
  EXPECT_EQ(drive->kind, TaskKind::passage);
  EXPECT_DOUBLE_EQ(drive->width_m, 0.7);
  const Point ahead = (drive->about - drive->lookout).normalized();
  EXPECT_NEAR((drive->beyond_m - drive->about).normalized().dot(ahead), 1.0, 1e-9);
  EXPECT_GT((drive->beyond_m - drive->about).norm(), kRadius_m);
}

TEST(PassageTasks, ADoorThatTheMapDrawsTooNarrowIsDrivenThroughWhenItIsHeardToBeWide) {
  EXPECT_TRUE(Passing(2).look(0.75));
}

TEST(PassageTasks, OneThatWasLookedAtAndNotDrivenThroughYetIsDrivenThroughNext) {
  Passing passing(5);
  ASSERT_TRUE(passing.look(0.7));
  const std::optional<ExploreTask> task = passing.next();
  ASSERT_TRUE(task);
  EXPECT_EQ(task->kind, TaskKind::passage);
}

TEST(PassageTasks, WhatWasTriedMovesWithTheMap) {
  Passing passing(5);
  const ExploreTask drive = *passing.look(0.7);
  const Pose2 T{3.0, -2.0, radians(90.0)};
  passing.tasks.move({{passing.trace[0]}, {T * passing.trace[0]}});
  ASSERT_TRUE(passing.next());
  EXPECT_EQ(passing.next()->kind, TaskKind::opening) << "the one at the old place is another";
  passing.tasks.move({{passing.trace[0]}, {inverse(T) * passing.trace[0]}});
  const std::optional<ExploreTask> again = passing.next();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->kind, TaskKind::passage);
  EXPECT_NEAR((again->beyond_m - drive.beyond_m).norm(), 0.0, 1e-9);
}

TEST(PassageTasks, OneThatWasNotGotThroughIsTriedOnceMoreAndLookedAtAgain) {
  Passing passing(5);
  passing.tasks.record(*passing.look(0.7), false, "the robot is blocked");
  EXPECT_FALSE(passing.next());
  EXPECT_TRUE(passing.tasks.retry());
  EXPECT_EQ(passing.next()->kind, TaskKind::opening);
  EXPECT_FALSE(passing.tasks.retry()) << "once only";
}

TEST(PassageTasks, OneThatWasNotGotThroughIsJudgedByTheNewLookAlone) {
  Passing passing(5);
  passing.tasks.record(*passing.look(0.7), false, "the robot is blocked");
  ASSERT_TRUE(passing.tasks.retry());
  const std::optional<ExploreTask> drive = passing.look(0.6);
  ASSERT_TRUE(drive);
  EXPECT_DOUBLE_EQ(drive->width_m, 0.6) << "the wider one had its middle elsewhere";
}

TEST(PassageTasks, OneThatIsFoundAmongTheLastIsTriedTwiceTooAndLookedAtAgainBefore) {
  Passing passing(5);
  (void)passing.tasks.retry();
  passing.tasks.record(*passing.look(0.7), false, "the robot is blocked");
  ASSERT_TRUE(passing.next());
  EXPECT_EQ(passing.next()->kind, TaskKind::opening);
  passing.tasks.record(*passing.look(0.7), false, "the robot is blocked");
  EXPECT_FALSE(passing.next());
}

TEST(PassageTasks, OneThatWasNotGotThroughIsReportedWithItsPlaceWidthAndReason) {
  Passing passing(5);
  passing.tasks.record(*passing.look(0.7), false, "the robot is blocked");
  const std::vector<NotEntered> left = passing.not_entered();
  ASSERT_EQ(left.size(), 1U);
  EXPECT_FALSE(left[0].is_too_narrow);
  EXPECT_EQ(left[0].why, "the robot is blocked");
  EXPECT_DOUBLE_EQ(left[0].width_m, 0.7);
}

TEST(PassageTasks, OneThatWasNeverTriedIsReportedAsThat) {
  const std::vector<NotEntered> left = Passing(5).not_entered();
  ASSERT_EQ(left.size(), 1U);
  EXPECT_FALSE(left[0].is_too_narrow);
  EXPECT_EQ(left[0].why, "not tried");
}

TEST(PassageTasks, AGapThatIsHeardToBeNarrowIsReportedAsTooNarrowAndCountsAsClosed) {
  Passing passing(2);
  EXPECT_FALSE(passing.look(0.2));
  EXPECT_FALSE(passing.next());
  const std::vector<NotEntered> left = passing.not_entered();
  ASSERT_EQ(left.size(), 1U);
  EXPECT_TRUE(left[0].is_too_narrow);
  EXPECT_EQ(left[0].why, "too narrow for 0.40 m");
  EXPECT_EQ(passing.tasks.closed().size(), 1U);
}

TEST(PassageTasks, AGapThatIsHeardToBeNarrowIsLookedAtOnceMoreFromNearerAndTheWiderLookCounts) {
  Passing passing(2);
  const Point first = passing.next()->lookout;
  const Point gap = passing.next()->about;
  EXPECT_FALSE(passing.look(0.15));
  EXPECT_TRUE(passing.tasks.retry());
  EXPECT_TRUE(passing.tasks.closed().empty()) << "not before it was looked at again";
  const std::optional<ExploreTask> again = passing.next();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->kind, TaskKind::opening);
  EXPECT_LT((again->lookout - gap).norm(), (first - gap).norm());
  EXPECT_FALSE(passing.look(0.1));
  EXPECT_DOUBLE_EQ(passing.not_entered()[0].width_m, 0.15);
  EXPECT_FALSE(passing.next());
  EXPECT_FALSE(passing.tasks.retry());
  Passing door(2);
  EXPECT_FALSE(door.look(0.26));
  EXPECT_TRUE(door.tasks.retry());
  EXPECT_TRUE(door.look(0.7)) << "the first look had missed most of it";
}

// Looked at, and once more when nothing else was left. The drive into it.
ExploreTask dared(Passing& passing, double heard_m) {
  EXPECT_FALSE(passing.look(heard_m));
  EXPECT_TRUE(passing.tasks.retry());
  return passing.look(heard_m).value();
}

TEST(PassageTasks, AtTheEndAGapHeardHalfAsWideAsTheRobotIsDrivenIntoInTheMiddleAndAtBothSidesOfIt) {
  Passing passing(2);
  const ExploreTask first = dared(passing, 0.3);
  EXPECT_EQ(first.kind, TaskKind::passage);
  const Point ahead = (first.about - first.lookout).normalized();
  const auto aside_m = [&](const ExploreTask& task) {
    return (task.about - first.about).dot(Point(-ahead.y(), ahead.x()));
  };
  passing.tasks.record(first, false, "blocked");
  const ExploreTask second = passing.next().value();
  EXPECT_NEAR(aside_m(second), 0.12, 1e-9);
  passing.tasks.record(second, false, "blocked");
  const ExploreTask third = passing.next().value();
  EXPECT_NEAR(aside_m(third), -0.12, 1e-9);
  passing.tasks.record(third, false, "blocked");
  EXPECT_FALSE(passing.next());
  EXPECT_EQ(passing.not_entered().at(0).why, "too narrow for 0.40 m");
}

TEST(PassageTasks, AGapThatWasDaredAndPassedIsNotTooNarrow) {
  Passing passing(2);
  passing.tasks.record(dared(passing, 0.3), true, {});
  EXPECT_TRUE(passing.tasks.closed().empty());
  EXPECT_TRUE(passing.not_entered().empty());
}

TEST(PassageTasks, AGapThatTheMapDrawsShutMeanwhileIsDaredToo) {
  Passing passing(2);
  EXPECT_FALSE(passing.look(0.3));
  EXPECT_TRUE(passing.tasks.retry());
  passing.map = AsciiGrid(room(0));
  const std::optional<ExploreTask> task = passing.next();
  ASSERT_TRUE(task);
  EXPECT_EQ(task->kind, TaskKind::passage);
}

TEST(PassageTasks, OneThatTheRobotCannotGetToIsReportedAsThat) {
  Passing passing(5);
  passing.tasks.record_unreachable(*passing.next());
  EXPECT_FALSE(passing.next());
  ASSERT_EQ(passing.not_entered().size(), 1U);
  EXPECT_EQ(passing.not_entered()[0].why, "no path leads to it");
  EXPECT_FALSE(passing.not_entered()[0].is_too_narrow);
  EXPECT_TRUE(passing.tasks.retry());
  EXPECT_TRUE(passing.next()) << "from where the robot is at the end";
}

TEST(PassageTasks, TheWayBackLeadsThroughAPassageThatWasPassedTheOtherWayRound) {
  Passing passing(5);
  const ExploreTask there = *passing.look(0.7);
  const std::vector<Point> back{there.beyond_m, there.lookout};
  EXPECT_FALSE(passing.tasks.passed_on(back, kRadius_m)) << "it was not passed yet";
  passing.tasks.record(there, true, {});
  const std::optional<ExploreTask> task = passing.tasks.passed_on(back, kRadius_m);
  ASSERT_TRUE(task);
  EXPECT_LT((task->beyond_m - task->about).dot(there.beyond_m - there.about), 0.0);
  EXPECT_FALSE(passing.tasks.passed_on({{0.0, 0.0}, {0.5, 0.0}}, kRadius_m)) << "not on this path";
}

TEST(PassageTasks, WhoHasJustComeThroughDoesNotGoThroughAgainOnTheWayOn) {
  Passing passing(5);
  const ExploreTask there = *passing.look(0.9);
  passing.tasks.record(there, true, {});
  const Point ahead = (there.beyond_m - there.about).normalized();
  const Point behind = there.about + 0.4 * ahead;
  EXPECT_FALSE(passing.tasks.passed_on({behind, behind + 2.0 * ahead}, kRadius_m));
  EXPECT_TRUE(passing.tasks.passed_on({behind, there.lookout}, kRadius_m)) << "back";
}

TEST(PassageTasks, OneIsNotPassedToAndFroForEver) {
  Passing passing(5);
  const ExploreTask there = *passing.look(0.7);
  passing.tasks.record(there, true, {});
  int drives = 0;
  for (std::optional<ExploreTask> task;
       drives < 100 && (task = passing.tasks.passed_on({there.lookout, there.beyond_m}, kRadius_m)); ++drives)
    passing.tasks.record(*task, true, {});
  EXPECT_EQ(drives, PassageSettings{}.max_passes - 1);
}

TEST(PassageTasks, OneThatWasPassedAndIsBlockedNowIsNotDrivenIntoForEver) {
  Passing passing(5);
  const ExploreTask there = *passing.look(0.7);
  passing.tasks.record(there, true, {});
  const std::vector<Point> path{there.lookout, there.beyond_m};
  int drives = 0;
  while (drives < 100 && passing.tasks.passed_on(path, kRadius_m)) {
    passing.tasks.record(there, false, "blocked");
    ++drives;
  }
  EXPECT_EQ(drives, PassageSettings{}.max_tries);
  EXPECT_TRUE(passing.tasks.retry());
  EXPECT_TRUE(passing.tasks.passed_on(path, kRadius_m)) << "once more before the end";
  passing.tasks.record(there, true, {});
  EXPECT_TRUE(passing.tasks.passed_on(path, kRadius_m));
}

TEST(PassageTasks, ASentenceNamesThePlaceTheWidthAndTheReason) {
  EXPECT_EQ(sentence_of(NotEntered{{2.4, 4.0}, 0.4, true, "too narrow for 0.44 m"}),
            "opening at (2.40, 4.00), 0.40 m wide: too narrow for 0.44 m");
  EXPECT_EQ(sentence_of(NotEntered{{2.4, 4.0}, 0.0, true, "too narrow for 0.44 m"}),
            "opening at (2.40, 4.00), drawn shut in the map: too narrow for 0.44 m");
}

}  // namespace
}  // namespace cairn::behaviours
