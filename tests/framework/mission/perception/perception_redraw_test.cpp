#include <memory>
#include <vector>

#include "tests/framework/mission/perception/perception_fixture.hpp"

namespace cairn {
namespace {

// From the localizer's answer to the map; a map that is to be drawn anew is.
class RedrawTest : public PerceptionTest {
 protected:
  RedrawTest() {
    built_.localizer = correcting_;
    (void)perception().begin();
  }
  // Whether the maps were exchanged.
  bool tick(double x_m, std::size_t readings = 2) {
    const Observation seen = observation(readings, x_m);
    pose_ = perception().localize(seen);
    if (perception().is_map_moved()) perception().begin_redraw(next_ = std::make_shared<CountingMapper>());
    const OccupancyGrid* const grid = perception().redraw_slice(pose_);
    changes_ = perception().map(seen, pose_);
    if (grid != nullptr) {
      EXPECT_EQ(grid, &next_->grid());
    }
    return grid != nullptr;
  }
  [[nodiscard]] double first_x_m() { return perception().tracker().driven_path().front().x_m; }

  const std::shared_ptr<CorrectingLocalizer> correcting_ = std::make_shared<CorrectingLocalizer>();
  std::shared_ptr<CountingMapper> next_;
  PoseEstimate pose_;
  CellChanges changes_;
};

TEST_F(RedrawTest, AMapOfAPastThatWasCorrectedIsDrawnAnewAtTheCorrectedPoses) {
  tick(0.0);
  tick(1.0);
  correcting_->correct(0.05);
  EXPECT_FALSE(tick(2.0));
  EXPECT_EQ(next_, nullptr) << "by less than what a map is drawn anew for";
  EXPECT_NEAR(pose_.T_map_robot.x_m, 2.0 + 1.05, 1e-12) << "and small enough for the pose to jump";
  correcting_->correct(0.5);
  EXPECT_TRUE(tick(3.0)) << "a small past is drawn in one slice";
  EXPECT_EQ(next_->readings, 8U) << "of three observations, and of this one";
  EXPECT_NEAR(next_->at.x_m, 3.0 + 1.55, 1e-12);
  EXPECT_FALSE(changes_.spans.empty()) << "the detector examines all of it";
  EXPECT_EQ(mapper_->readings, 6U) << "the earlier map gets nothing more";
  EXPECT_NEAR(first_x_m(), 1.55, 1e-12);
}

// Each is as much as a slice may hold, but for the two that a slice holds at least.
constexpr std::size_t kLargeScan = 300;

TEST_F(RedrawTest, UntilAllIsDrawnEveryoneSeesTheOldMapAndTheRobotsPlaceInIt) {
  for (int i = 0; i < 6; ++i) tick(0.1 * i, kLargeScan);
  correcting_->correct(0.5);
  EXPECT_FALSE(tick(1.0, kLargeScan));
  ASSERT_NE(next_, nullptr);
  EXPECT_EQ(next_->readings, 2 * kLargeScan);
  EXPECT_NEAR(pose_.T_map_robot.x_m, 1.0 + 1.0, 1e-12) << "in the old map the robot has not jumped";
  EXPECT_NEAR(mapper_->at.x_m, 2.0, 1e-12) << "which goes on being drawn";
  EXPECT_NEAR(first_x_m(), 1.0, 1e-12);
  int ticks = 1;
  while (!tick(1.0 + ticks, kLargeScan) && ticks < 20) {
    EXPECT_NEAR(pose_.T_map_robot.x_m, 2.0 + ticks, 1e-12);
    ++ticks;
  }
  EXPECT_EQ(ticks, 4) << "two a tick of 6, and one more comes each tick";
  EXPECT_NEAR(pose_.T_map_robot.x_m, 2.5 + ticks, 1e-12) << "with the map the pose moves";
  EXPECT_EQ(next_->readings, 11 * kLargeScan) << "all that came, and none twice";
  EXPECT_NEAR(first_x_m(), 1.5, 1e-12);
  EXPECT_FALSE(tick(9.0));
  EXPECT_NEAR(pose_.T_map_robot.x_m, 10.5, 1e-12);
}

TEST_F(RedrawTest, WhatIsCorrectedMeanwhileWaitsForTheNextTime) {
  for (int i = 0; i < 6; ++i) tick(0.1 * i, kLargeScan);
  correcting_->correct(0.5);
  EXPECT_FALSE(tick(1.0, kLargeScan));
  correcting_->correct(0.4);
  EXPECT_FALSE(tick(1.0, kLargeScan));
  EXPECT_NEAR(pose_.T_map_robot.x_m, 2.0, 1e-12);
  const std::shared_ptr<CountingMapper> first = next_;
  for (int i = 0; i < 20 && !tick(1.0, kLargeScan); ++i) EXPECT_NEAR(pose_.T_map_robot.x_m, 2.0, 1e-12);
  EXPECT_EQ(next_, first) << "the one under way comes to its end";
  EXPECT_NEAR(pose_.T_map_robot.x_m, 2.5, 1e-12);
  for (int i = 0; i < 40 && !tick(1.0); ++i) EXPECT_NEAR(pose_.T_map_robot.x_m, 2.5, 1e-12);
  EXPECT_NE(next_, first);
  EXPECT_NEAR(pose_.T_map_robot.x_m, 2.9, 1e-12);
  EXPECT_NEAR(first_x_m(), 1.9, 1e-12);
}

TEST_F(RedrawTest, LandmarksMoveWithTheMapAndSoThoseWhoLookOnAreTold) {
  mission_.config.landmarks.confirm_sightings = 1;
  perception_.reset();
  (void)perception().begin();
  for (int i = 0; i < 6; ++i) tick(0.1 * i, kLargeScan);
  detector_->next.matchings = {square_at(1.0)};
  (void)perception().recognise({}, 0.5);
  const auto landmark_x_m = [&] {
    return perception().tracker().graph().landmarks().begin()->second.T_map_landmark.x_m;
  };
  correcting_->correct(0.5);
  EXPECT_FALSE(tick(1.0, kLargeScan));
  EXPECT_NEAR(landmark_x_m(), 1.0, 1e-12);
  while (!tick(1.0, kLargeScan)) {
  }
  EXPECT_NEAR(landmark_x_m(), 1.5, 1e-12);
  const Recognition recognised = perception().recognise({}, 0.6);
  EXPECT_EQ(kinds_of(recognised), (std::vector{Event(LandmarkChanged{}).index()}));
  EXPECT_NEAR(perception().last_move()->near({1.0, 0.0}).x_m, 0.5, 1e-12);
}

TEST_F(RedrawTest, ARunThatEndsMeanwhileDrawsAllOfIt) {
  for (int i = 0; i < 6; ++i) tick(0.1 * i, kLargeScan);
  correcting_->correct(0.5);
  EXPECT_FALSE(tick(1.0, kLargeScan));
  EXPECT_TRUE(perception().finish());
  const auto last = std::make_shared<CountingMapper>();
  EXPECT_EQ(&perception().redraw(last), &last->grid());
  EXPECT_EQ(last->readings, 7 * kLargeScan);
  EXPECT_NEAR(perception().past().poses().back().T_map_robot.x_m, 2.5 + 0.02, 1e-12);
}

TEST_F(RedrawTest, BetweenACorrectionAndItsRedrawNoNodesAreThereToBeSaved) {
  for (int i = 0; i < 6; ++i) tick(0.1 * i, kLargeScan);
  EXPECT_EQ(perception().submaps().nodes.size(), 6U);
  correcting_->correct(0.5);
  EXPECT_FALSE(tick(1.0, kLargeScan));
  EXPECT_TRUE(perception().submaps().empty()) << "the map is not where they are";
  while (!tick(1.0, kLargeScan)) {
  }
  ASSERT_FALSE(perception().submaps().empty());
  EXPECT_NEAR(perception().submaps().nodes.front().T_map_node.x_m, first_x_m(), 1e-12);
}

TEST_F(RedrawTest, ARunThatIsCancelledBeforeTheRedrawSavesNoNodes) {
  for (int i = 0; i < 3; ++i) tick(0.1 * i);
  correcting_->correct(0.5);
  is_cancelled_ = true;
  EXPECT_TRUE(perception().finish());
  EXPECT_EQ(&perception().redraw(std::make_shared<CountingMapper>()), &mapper_->grid());
  EXPECT_TRUE(perception().submaps().empty());
}

TEST_F(PerceptionTest, TagsThatMoveWithACorrectedPastAreReportedOnce) {
  mission_.config.markers.emplace();
  const auto correcting = std::make_shared<CorrectingLocalizer>();
  built_.localizer = correcting;
  built_.marker_detector = std::make_shared<TagSevenDetector>();
  (void)perception().begin();
  for (int i = 0; i < 20; ++i) {
    Observation seen;
    seen.stamp_s = 0.1 * i;
    seen.T_odom_robot = TagSevenDetector::odometry_at(seen.stamp_s);
    seen.images.resize(1);
    seen.images[0].stamp_s = seen.stamp_s;
    perception().see_markers(seen);
    perception().map(seen, perception().localize(seen));
    (void)perception().recognise({}, seen.stamp_s, seen.markers);
  }
  ASSERT_EQ(perception().tracker().graph().landmarks().size(), 1U);
  correcting->correct(0.5);
  ASSERT_TRUE(perception().finish());
  (void)perception().redraw(std::make_shared<CountingMapper>());
  const std::vector<Event> events = perception().take_moved_landmarks();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(std::get<LandmarkChanged>(events[0]).landmark.T_map_landmark.x_m, 4.0 + 1.0 + 0.52, 0.02);
  EXPECT_TRUE(perception().take_moved_landmarks().empty());
}

TEST_F(PerceptionTest, TheLastCorrectionsAreAskedForUntilNothingIsLeft) {
  const auto correcting = std::make_shared<CorrectingLocalizer>();
  built_.localizer = correcting;
  (void)perception().begin();
  EXPECT_FALSE(perception().finish()) << "nothing was observed";
  const Observation seen = observation(2, 0.0);
  perception().map(seen, perception().localize(seen));
  EXPECT_TRUE(perception().finish());
  EXPECT_EQ(correcting->parts_left, 0);
  (void)perception().redraw(std::make_shared<CountingMapper>());
  EXPECT_NEAR(perception().past().poses().front().T_map_robot.x_m, 1.02, 1e-12);
  EXPECT_FALSE(perception().finish()) << "all is drawn where it is known to be";
}

}  // namespace
}  // namespace cairn
