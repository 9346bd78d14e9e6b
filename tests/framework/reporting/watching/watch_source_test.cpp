#include "framework/reporting/watching/watch_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/reporting/event_sentences.hpp"

namespace cairn {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Frame = std::shared_ptr<const WatchFrame>;

class WatchedMission : public testing::Test {
 protected:
  WatchedMission() {
    observation_.ranges = {{{0.1, 0.0, 0.0}, 0.1, 0.1, 5.0, 1.5, 0}};
    grid_.set_log_odds({0, 0}, 500);
  }
  void publish(const Event& event) { source_.on(event, {view()}); }
  void tick(const CellChanges& changes = {}) {
    time_s_ += 0.1;
    publish(TickDone{&changes});
  }
  [[nodiscard]] WorldView view() const { return {*shown_, graph_, robot_, {{1.0, 2.0, 0.5}}, time_s_, &observation_}; }
  // The frame of the next tick.
  Frame frame_of(WatchSource::Watch& watch, const CellChanges& changes = {}) {
    EXPECT_EQ(watch.next(milliseconds(0), false), nullptr) << "a frame that nobody has waited for";
    tick(changes);
    return watch.next(milliseconds(0), false);
  }

  WatchSource source_;
  OccupancyGrid grid_{0.05};
  const OccupancyGrid* shown_ = &grid_;
  LandmarkGraph graph_;
  RobotModel robot_;
  Observation observation_;
  double time_s_ = 0.0;
};

TEST_F(WatchedMission, TheFirstFrameHoldsAllAndTheNextWhatHasChanged) {
  Landmark landmark;
  landmark.category = "square";
  const LandmarkId id = graph_.add(landmark);
  for (int i = 0; i < 3; ++i) tick();
  const auto watch = source_.attach(1);
  const Frame first = frame_of(*watch);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->is_afresh);
  EXPECT_EQ(first->tick, 4) << "those before it was watched count";
  EXPECT_EQ(first->pose.T_map_robot, (Pose2{1.0, 2.0, 0.5}));
  ASSERT_THAT(first->tiles, SizeIs(1));
  EXPECT_EQ(first->tiles[0].ol[0], ol_of(500));
  EXPECT_EQ(first->tiles[0].ol[1], kUnknownOl);
  ASSERT_THAT(first->landmarks, SizeIs(1));
  EXPECT_EQ(first->landmarks[0].id, id);
  ASSERT_TRUE(first->routes);

  grid_.set_log_odds({70, 1}, -300);
  const Frame second = frame_of(*watch, {{{1, 70, 71}}});
  EXPECT_FALSE(second->is_afresh);
  ASSERT_THAT(second->tiles, SizeIs(1));
  EXPECT_EQ(second->tiles[0].tile, (Cell{1, 0}));
  EXPECT_EQ(second->tiles[0].ol[64 + 6], ol_of(-300));
  EXPECT_THAT(second->landmarks, IsEmpty());
  EXPECT_FALSE(second->routes) << "they are as they were";
  EXPECT_THAT(frame_of(*watch)->tiles, IsEmpty());
}

TEST_F(WatchedMission, ClustersComeWhenTheyAreOthers) {
  Landmark landmark;
  landmark.category = "square";
  const LandmarkId id = graph_.add(landmark);
  ClusterTree tree;
  WatchSource::Look look;
  look.clusters = [&] { return tree; };
  source_.look_by(look);
  const auto watch = source_.attach(1);
  EXPECT_FALSE(frame_of(*watch)->clusters);
  tree.clusters[4] = {4, 1, 0, id, "kitchen"};
  tree.cluster_of[id] = 4;
  EXPECT_FALSE(frame_of(*watch)->clusters) << "once a second";
  time_s_ += 1.0;
  const Frame frame = frame_of(*watch);
  ASSERT_TRUE(frame->clusters);
  ASSERT_THAT(*frame->clusters, SizeIs(1));
  EXPECT_EQ(frame->clusters->front().label, "kitchen");
  EXPECT_THAT(frame->clusters->front().landmarks, ElementsAre(id));
  time_s_ += 1.0;
  EXPECT_FALSE(frame_of(*watch)->clusters) << "they are as they were";
}

TEST_F(WatchedMission, OneWhoComesLateGetsTheSentencesOfBeforeOnce) {
  std::vector<std::string> said;
  source_.look_by({{}, {}, {}, [&] { return said; }});
  const auto say = [&](const std::string& name) {
    const StepStarted event{0, name};
    said.push_back("0.10 s: " + sentence_of(event));
    publish(event);
  };
  say("early");
  const auto watch = source_.attach(1);
  say("as it came");
  const Frame first = frame_of(*watch);
  EXPECT_THAT(first->past, ElementsAre(HasSubstr("early"), HasSubstr("as it came")));
  EXPECT_THAT(first->lines, IsEmpty());
  say("later");
  const Frame second = frame_of(*watch);
  EXPECT_THAT(second->past, IsEmpty());
  ASSERT_THAT(second->lines, SizeIs(1));
  EXPECT_THAT(second->lines[0].sentence, HasSubstr("later"));
}

TEST_F(WatchedMission, OneWhoDoesNotComeBackMissesFramesButNoChange) {
  const auto busy = source_.attach(2);
  const auto stalled = source_.attach(2);
  (void)frame_of(*busy);
  for (int i = 0; i < 50; ++i) {
    grid_.set_log_odds({100 + i, 0}, 400);
    (void)frame_of(*busy, {{{0, 100 + i, 101 + i}}});
  }
  const Frame late = frame_of(*stalled);
  EXPECT_EQ(late->tick, 52);
  ASSERT_THAT(late->tiles, SizeIs(3)) << "each once";
}

TEST_F(WatchedMission, AFrameHasABoundAndTheRestComesLater) {
  for (int i = 0; i < 300; ++i) grid_.set_log_odds({64 * i, 0}, 100);
  const auto watch = source_.attach(1);
  const Frame first = frame_of(*watch);
  EXPECT_THAT(first->tiles, SizeIs(kMaxFrameTiles));
  EXPECT_TRUE(first->has_more);
  const Frame second = frame_of(*watch);
  EXPECT_THAT(second->tiles, SizeIs(300 - kMaxFrameTiles));
  EXPECT_FALSE(second->has_more);
}

TEST_F(WatchedMission, LinesKeepTheirOrderAndTheOldestGo) {
  const auto watch = source_.attach(1);
  (void)frame_of(*watch);
  for (std::size_t i = 0; i < kMaxWatchedLines + 100; ++i) publish(Message{"line " + std::to_string(i)});
  const Frame frame = frame_of(*watch);
  ASSERT_THAT(frame->lines, SizeIs(kMaxWatchedLines));
  EXPECT_EQ(frame->lines_left_out, 100U);
  EXPECT_EQ(frame->lines.front().sentence, "line 100");
  EXPECT_EQ(frame->lines.back().sentence, "line " + std::to_string(kMaxWatchedLines + 99));
  EXPECT_THAT(frame_of(*watch)->lines, IsEmpty());
}

TEST_F(WatchedMission, AnotherGridBeginsAfresh) {
  const auto watch = source_.attach(1);
  (void)frame_of(*watch);
  OccupancyGrid other(0.1);
  other.set_log_odds({640, 640}, 50);
  shown_ = &other;
  const Frame frame = frame_of(*watch);
  EXPECT_TRUE(frame->is_afresh);
  EXPECT_EQ(frame->cell_m, 0.1);
  ASSERT_THAT(frame->tiles, SizeIs(1));
  EXPECT_EQ(frame->tiles[0].tile, (Cell{10, 10}));
}

TEST_F(WatchedMission, APlanLastsUntilTheBehaviourEnds) {
  const auto watch = source_.attach(1);
  PlanResult plan;
  plan.path = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  (void)frame_of(*watch);
  publish(PlanDone{plan});
  const Frame under_way = frame_of(*watch);
  ASSERT_TRUE(under_way->plan);
  EXPECT_THAT(under_way->plan->result.path, SizeIs(2));
  publish(StepEnded{0, "goto", {StepState::success, ""}});
  EXPECT_FALSE(frame_of(*watch)->plan);
  plan.path.push_back({1.1, 2.0, 0.0});
  publish(PlanDone{plan});
  EXPECT_FALSE(frame_of(*watch)->plan) << "the robot stands on its goal";
}

TEST_F(WatchedMission, APathOfABehaviourIsShownWhereNoPlanIsUnderWay) {
  const auto watch = source_.attach(1);
  (void)frame_of(*watch);
  publish(PathStarted{{Point(2.0, 0.0), Point(2.0, 3.0)}});
  const Frame explored = frame_of(*watch);
  ASSERT_TRUE(explored->plan);
  EXPECT_EQ(explored->plan->result.path.back(), (Pose2{2.0, 3.0, 0.0}));
  EXPECT_DOUBLE_EQ(explored->plan->result.length_m, 3.0);
  publish(PathStarted{{Point(2.0, 0.0), Point(4.0, 0.0)}});
  EXPECT_EQ(frame_of(*watch)->plan->result.path.back(), (Pose2{4.0, 0.0, 0.0})) << "a later one takes its place";
  PlanResult plan;
  plan.path = {{0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}};
  publish(PlanDone{plan});
  publish(PathStarted{{Point(0.0, 0.0), Point(2.5, 0.0)}});
  EXPECT_EQ(frame_of(*watch)->plan->result.path.back(), (Pose2{5.0, 0.0, 0.0})) << "a part of the plan";
}

TEST_F(WatchedMission, RetiredLandmarksAreNamed) {
  const LandmarkId id = graph_.add({});
  const auto watch = source_.attach(1);
  (void)frame_of(*watch);
  const Landmark landmark = *graph_.find(id);
  graph_.retire(id, "freed");
  publish(LandmarkRetired{landmark, "freed"});
  EXPECT_THAT(frame_of(*watch)->retired, testing::ElementsAre(id));
}

TEST_F(WatchedMission, WhatIsLeftAtTheEndComesWithTheLastFrame) {
  const auto watch = source_.attach(1);
  (void)frame_of(*watch);
  for (int i = 0; i < 300; ++i) grid_.set_log_odds({64 * i, 0}, 100);
  tick({{{0, 0, 64 * 300}}});
  publish(MapSaved{"held.cairn"});
  source_.end(&grid_, graph_);
  EXPECT_FALSE(watch->has_ended());
  const Frame last = watch->next(milliseconds(0), false);
  ASSERT_TRUE(last);
  EXPECT_TRUE(last->is_last);
  EXPECT_THAT(last->tiles, SizeIs(300));
  ASSERT_THAT(last->lines, SizeIs(1));
  EXPECT_EQ(last->lines[0].sentence, "saved held.cairn");
  EXPECT_TRUE(watch->has_ended());
  EXPECT_FALSE(watch->next(milliseconds(0), false));
}

TEST_F(WatchedMission, OfSonarsThatFireInTurnTheLastOfEachIsShownForASecond) {
  const auto watch = source_.attach(1);
  (void)frame_of(*watch);
  observation_.ranges[0].sensor = 1;
  observation_.ranges[0].range_m = 2.0;
  (void)frame_of(*watch);
  observation_.ranges[0].range_m = 2.5;
  const Frame frame = frame_of(*watch);
  ASSERT_THAT(frame->ranges, SizeIs(2));
  EXPECT_EQ(frame->ranges[0].reading.range_m, 1.5);
  EXPECT_EQ(frame->ranges[1].reading.range_m, 2.5);
  EXPECT_EQ(frame->ranges[1].T_map_sensor, (Pose2{1.0, 2.0, 0.5} * Pose2{0.1, 0.0, 0.0}));
  for (int i = 0; i < 12; ++i) (void)frame_of(*watch);
  EXPECT_THAT(frame_of(*watch)->ranges, SizeIs(1));
}

TEST_F(WatchedMission, OnlySoManyMayWatch) {
  auto first = source_.attach(1);
  EXPECT_FALSE(source_.attach(1));
  first.reset();
  EXPECT_TRUE(source_.attach(1));
}

TEST_F(WatchedMission, TimesOfTheStagesComeOnceASecond) {
  std::int64_t calls = 0;
  source_.look_by({{}, {}, {}, {}, [&calls] {
                     StageTime time;
                     time.stage = "map";
                     time.count = ++calls;
                     return std::vector{time};
                   }});
  tick();
  const auto watch = source_.attach(1);
  (void)watch->next(milliseconds(0), false);
  int with_times = 0;
  for (int i = 0; i < 25; ++i) with_times += frame_of(*watch)->times.empty() ? 0 : 1;
  EXPECT_EQ(with_times, 3);
  EXPECT_EQ(calls, 3);
}

TEST_F(WatchedMission, TheStatusIsAskedForOnlyWhenItIsWanted) {
  int asked = 0;
  source_.look_by({[&asked] {
                     ++asked;
                     return RunStatus{};
                   },
                   {},
                   {}});
  tick();
  const auto watch = source_.attach(1);
  EXPECT_FALSE(frame_of(*watch)->status);
  EXPECT_EQ(asked, 0);
  EXPECT_FALSE(watch->next(milliseconds(0), true));
  tick();
  const Frame frame = watch->next(milliseconds(0), false);
  EXPECT_TRUE(frame->status);
  EXPECT_EQ(asked, 1);
}

}  // namespace
}  // namespace cairn
