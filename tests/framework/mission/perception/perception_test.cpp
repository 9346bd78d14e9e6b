#include "framework/mission/perception/perception.hpp"

#include <limits>
#include <memory>

#include "tests/framework/mission/perception/perception_fixture.hpp"

namespace cairn {
namespace {

TEST_F(PerceptionTest, TheMapperGetsThePoseThatTheLocalizerReturned) {
  (void)perception().begin();
  const Observation seen = observation(2, 0.5);
  const PoseEstimate pose = perception().localize(seen);
  EXPECT_EQ(pose.T_map_robot, (Pose2{1.5, 0.0, 0.0}));
  perception().map(seen, pose);
  EXPECT_EQ(mapper_->at, pose.T_map_robot);
  EXPECT_EQ(perception().tracker().driven_path().size(), 1U);
}

TEST_F(PerceptionTest, TheLocalizerKnowsTheLandmarksThatEarlierObservationsHaveShown) {
  mission_.config.landmarks.confirm_sightings = 1;
  (void)perception().begin();
  (void)perception().localize(observation(0));
  EXPECT_EQ(localizer_->landmarks_known, 0U);
  detector_->next.matchings = {square_at(1.0)};
  (void)perception().recognise({}, 0.5);
  (void)perception().localize(observation(0));
  EXPECT_EQ(localizer_->landmarks_known, 1U);
}

TEST_F(PerceptionTest, ReadingsThatAreHeldOutAreHiddenFromTheMapOnly) {
  mission_.config.hold_out_every = 2;
  (void)perception().begin();
  for (int i = 0; i < 3; ++i) {
    const Observation seen = observation(4);
    perception().map(seen, perception().localize(seen));
  }
  EXPECT_EQ(localizer_->readings, 12U);
  EXPECT_EQ(mapper_->readings, 6U);
}

TEST_F(PerceptionTest, WhatDeafTransducersDoNotHearIsHiddenFromTheMap) {
  (void)perception().begin();
  Observation seen = observation(3);
  for (int i = 0; i < 3; ++i) seen.ranges[static_cast<std::size_t>(i)].sensor = i;
  seen.ranges[1].range_m = 1.0;
  const PoseEstimate pose = perception().localize(seen);
  perception().map(seen, pose, std::vector<int>{0, 1});
  EXPECT_EQ(mapper_->readings, 2U) << "an echo is one, whoever hears it";
  perception().map(seen, pose);
  EXPECT_EQ(mapper_->readings, 5U);
}

TEST_F(PerceptionTest, APoseThatIsNotFiniteIsAFaultOfTheLocalizer) {
  (void)perception().begin();
  localizer_->offset_m = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)perception().localize(observation(0)), ModuleFault);
}

TEST_F(PerceptionTest, EachMatchingComesBeforeWhatItHasChanged) {
  mission_.config.landmarks.confirm_sightings = 2;
  (void)perception().begin();
  detector_->next.matchings = {square_at(1.0), square_at(1.0), square_at(5.0)};
  const Recognition recognised = perception().recognise({}, 0.5);
  EXPECT_EQ(recognised.matchings, 3);
  const std::size_t matching = Event(MatchingDone{}).index();
  const std::size_t landmark = Event(LandmarkChanged{}).index();
  EXPECT_EQ(kinds_of(recognised), (std::vector{matching, matching, landmark, matching}));
  EXPECT_TRUE(std::get<LandmarkChanged>(recognised.events[2]).is_new);
  EXPECT_EQ(perception().tracker().graph().landmarks().size(), 1U);
}

TEST_F(PerceptionTest, ADetectionThatIsNotFiniteIsAFaultAndNothingOfItsReportCounts) {
  mission_.config.landmarks.confirm_sightings = 1;
  (void)perception().begin();
  detector_->next.matchings = {square_at(1.0), square_at(std::numeric_limits<double>::quiet_NaN())};
  EXPECT_THROW((void)perception().recognise({}, 0.5), ModuleFault);
  EXPECT_TRUE(perception().tracker().graph().landmarks().empty());
}

TEST_F(PerceptionTest, TheGridOfAnEarlierRunIsShownToTheDetectorWithoutAnyMatching) {
  SavedMap map;
  map.progress = MissionProgress{};
  map.driven_path = {{1.0, 1.0, 0.0}};
  perception().restore(map);
  detector_->next.matchings = {square_at(1.0)};
  (void)perception().begin();
  (void)perception().show_earlier_map();
  EXPECT_EQ(detector_->shown, 1);
  EXPECT_TRUE(perception().tracker().graph().landmarks().empty());
  EXPECT_EQ(perception().tracker().driven_path(), map.driven_path);
}

TEST_F(PerceptionTest, PosesOfALocalizerThatNeverCorrectsAnyAreRecordedWhereTheyAreAskedFor) {
  (void)perception().begin(true);
  const Observation seen = observation(2, 0.0);
  perception().map(seen, perception().localize(seen));
  EXPECT_FALSE(perception().finish());
  ASSERT_EQ(perception().past().size(), 1U);
  EXPECT_EQ(perception().past().poses().front().T_map_robot.x_m, 1.0);
}

// Where tag 7 is in the map by pictures that are 0.2 s old, of a robot that drives 0.5 m/s.
class OldPicturesTest : public PerceptionTest {
 protected:
  double tag_x_m(double stamps_late_s) {
    mission_.config.markers.emplace();
    const auto tags = std::make_shared<TagSevenDetector>();
    tags->stamps_late_s = stamps_late_s;
    built_.marker_detector = tags;
    (void)perception().begin();
    for (int i = 0; i < 20; ++i) {
      Observation seen;
      seen.stamp_s = 0.1 * i;
      seen.T_odom_robot = TagSevenDetector::odometry_at(seen.stamp_s);
      if (i >= 2) seen.images.resize(1);
      for (CameraImage& image : seen.images) image.stamp_s = seen.stamp_s - 0.2;
      perception().see_markers(seen);
      perception().map(seen, perception().localize(seen));
      (void)perception().recognise({}, seen.stamp_s, seen.markers);
    }
    const Landmark* const tag = perception().tracker().graph().find_by_name("tag 7");
    return tag == nullptr ? std::numeric_limits<double>::quiet_NaN() : tag->T_map_landmark.x_m - localizer_->offset_m;
  }
};
TEST_F(OldPicturesTest, ShowATagWhereItIs) {
  EXPECT_NEAR(tag_x_m(0.0), 4.0, 0.02);
}

TEST_F(OldPicturesTest, ShowItElsewhereWhenTheyAreTakenForNew) {
  EXPECT_NEAR(tag_x_m(0.2), 4.1, 0.02) << "the robot has driven 0.1 m meanwhile";
}

TEST_F(PerceptionTest, WithoutADetectorNothingIsRecognised) {
  built_.detector = nullptr;
  (void)perception().begin();
  EXPECT_TRUE(perception().recognise({}, 10.0).events.empty());
  EXPECT_EQ(perception().recognise({}, 0.5).coarse, nullptr);
}

}  // namespace
}  // namespace cairn
