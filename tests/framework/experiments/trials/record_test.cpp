#include "framework/experiments/trials/record.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Ticks of 0.04 s from a string: '.' a reading, ' ' none; below it 'v' ordered to move, '0' to stand.
SilenceFigures silences(const std::string& readings, const std::string& orders) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  TrialRecord record;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    Observation observation;
    if (readings[i] == '.') observation.ranges.emplace_back();
    const WorldView world{grid, graph, robot, {}, 0.04 * static_cast<double>(i), &observation};
    MissionView view{world};
    if (orders[i] == 'v') view.commanded.v_mps = 0.2;
    record.on(TickDone{}, view);
  }
  return record.silences();
}

TEST(TrialRecord, CountsTheTicksFromTheFirstWithoutReadingsToTheStop) {
  EXPECT_EQ(silences("...   ..", "vvvv0000").silences, 1);
  EXPECT_EQ(silences("...   ..", "vvvv0000").worst_stop_ticks, 2);
  EXPECT_EQ(silences("...   ..", "vvv00000").worst_stop_ticks, 1);
  EXPECT_EQ(silences("...      ", "vvvvvvvv0").worst_stop_ticks, 6);
}

TEST(TrialRecord, OneThatMovesAgainDuringTheSilenceHasNotStopped) {
  EXPECT_EQ(silences("...      ", "vvvv00v00").worst_stop_ticks, 5);
}

TEST(TrialRecord, TheWorstOfAllSilencesCountsButNotThoseWhileStanding) {
  const SilenceFigures two = silences(".. .....    ..", "vv0vvvvvvv00vv");
  EXPECT_EQ(two.silences, 2);
  EXPECT_EQ(two.worst_stop_ticks, 3);
  const SilenceFigures standing = silences("...   ..", "00000000");
  EXPECT_EQ(standing.silences, 0);
  EXPECT_EQ(standing.worst_stop_ticks, 0);
}

// A moment a second.
std::vector<TrialMoment> drive(const std::vector<Pose2>& poses) {
  std::vector<TrialMoment> moments;
  for (const Pose2& pose : poses) moments.push_back({static_cast<double>(moments.size()), pose});
  return moments;
}

TEST(LongestStand, IsWithoutMovingOrTurning) {
  std::vector<Pose2> poses(10, Pose2{1.0, 1.0, 0.0});
  for (int i = 0; i < 20; ++i) poses.emplace_back(Pose2{1.2, 1.0, 0.0});
  poses.resize(35, Pose2{1.2, 1.0, radians(20.0)});
  const Stand stand = longest_stand(drive(poses), {});
  EXPECT_DOUBLE_EQ(stand.begin_s, 10.0);
  EXPECT_DOUBLE_EQ(stand.for_s, 19.0);
}

TEST(LongestStand, CreepingIsProgressAndTremblingIsNot) {
  std::vector<Pose2> creeping;
  std::vector<Pose2> trembling;
  for (int i = 0; i < 100; ++i) {
    creeping.emplace_back(Pose2{0.04 * i, 0.0, 0.0});
    trembling.emplace_back(Pose2{0.04 * (i % 2), 0.0, 0.0});
  }
  EXPECT_LE(longest_stand(drive(creeping), {}).for_s, 3.0);
  EXPECT_DOUBLE_EQ(longest_stand(drive(trembling), {}).for_s, 99.0);
}

TEST(LongestStand, WaitingOnPurposeAndAnEmptyBatteryDoNotCount) {
  std::vector<TrialMoment> moments = drive(std::vector<Pose2>(100, Pose2{}));
  EXPECT_DOUBLE_EQ(longest_stand(moments, {{20.0, 60.0}}).for_s, 39.0);
  for (std::size_t i = 30; i < 100; ++i) moments[i].is_empty = true;
  EXPECT_DOUBLE_EQ(longest_stand(moments, {}).for_s, 29.0);
  EXPECT_DOUBLE_EQ(longest_stand({}, {}).for_s, 0.0);
}

}  // namespace
}  // namespace cairn
