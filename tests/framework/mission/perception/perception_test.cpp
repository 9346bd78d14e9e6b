#include "framework/mission/perception/perception.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>

#include "framework/contracts/optional/pose_graph_report.hpp"
#include "tests/framework/mission/still_modules.hpp"

namespace cairn {
namespace {

class OffsetLocalizer : public Localizer {
 public:
  PoseEstimate update(const Observation& observation, const KnownMap& known) override {
    readings += observation.ranges.size();
    landmarks_known = known.landmarks.landmarks().size();
    PoseEstimate pose;
    pose.T_map_robot = {observation.T_odom_robot.x_m + offset_m, 0.0, 0.0};
    return pose;
  }
  double offset_m = 1.0;
  std::size_t readings = 0;
  std::size_t landmarks_known = 0;
};

// Finds out at some time that all poses so far were off by so much.
class CorrectingLocalizer : public OffsetLocalizer, public PoseHistory, public PoseGraphReport {
 public:
  PoseEstimate update(const Observation& observation, const KnownMap& known) override {
    PoseEstimate pose = OffsetLocalizer::update(observation, known);
    pose.T_map_robot.x_m += corrected_m_;
    poses_.push_back(pose.T_map_robot);
    return pose;
  }
  PoseHistory* history() override { return this; }
  void correct(double by_m) {
    for (Pose2& pose : poses_) pose.x_m += by_m;
    corrected_m_ += by_m;
    ++revision_;
  }
  [[nodiscard]] std::vector<Pose2> poses() const override { return poses_; }
  [[nodiscard]] std::uint64_t revision() const override { return revision_; }
  [[nodiscard]] KeptSubmaps submaps() const override {
    KeptSubmaps submaps;
    for (const Pose2& pose : poses_) submaps.nodes.push_back({std::ssize(submaps.nodes), 0.0, pose});
    return submaps;
  }
  bool finish_part() override {
    if (parts_left == 0) return false;
    if (--parts_left == 0) correct(0.02);
    return true;
  }
  int parts_left = 3;

 private:
  std::vector<Pose2> poses_;
  std::uint64_t revision_ = 0;
  double corrected_m_ = 0.0;
};

class CountingMapper : public Mapper {
 public:
  CountingMapper() { grid_.set_log_odds({3, 3}, 500); }
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    readings += observation.ranges.size();
    at = pose.T_map_robot;
    return changes_;
  }
  [[nodiscard]] const OccupancyGrid& grid() const override { return grid_; }
  std::size_t readings = 0;
  Pose2 at;

 private:
  OccupancyGrid grid_{0.1};
  CellChanges changes_;
};

class ScriptedDetector : public Detector {
 public:
  DetectionReport detect(const OccupancyGrid&, const CellChanges&, const Budget& budget) override {
    if (budget.cancelled()) {
      ++shown;
      return {};
    }
    return std::exchange(next, {});
  }
  DetectionReport next;
  int shown = 0;
};

// Tag 7 hangs 4 m ahead of where the odometry begins. Each picture shows it from where the robot was then.
class TagSevenDetector : public MarkerDetector {
 public:
  std::vector<MarkerSighting> detect(std::span<const CameraImage> images, const Budget&) override {
    std::vector<MarkerSighting> sightings;
    for (const CameraImage& image : images) {
      MarkerSighting& sighting = sightings.emplace_back();
      sighting.marker.number = 7;
      sighting.stamp_s = image.stamp_s + stamps_late_s;
      sighting.pose.T_robot_marker = inverse(odometry_at(image.stamp_s)) * Pose2{4.0, 0.5, radians(180.0)};
      sighting.pose.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-3).asDiagonal();
    }
    return sightings;
  }
  static Pose2 odometry_at(double stamp_s) { return {0.5 * stamp_s, 0.0, 0.0}; }
  double stamps_late_s = 0.0;
};

Matching square_at(double x_m) {
  Matching matching;
  matching.degrees = {{"square", 0.9, 0.0, {x_m, 1.0}}};
  matching.detection = Detection{"square", {x_m, 1.0, 0.0}, 0.9, {}};
  return matching;
}

class PerceptionTest : public testing::Test {
 protected:
  PerceptionTest() {
    mission_.steps.clear();
    built_.localizer = localizer_;
    built_.mapper = mapper_;
    built_.detector = detector_;
  }
  Perception& perception() {
    if (!perception_) {
      modules_ = std::make_unique<StagedModules>(built_, mission_, std::make_shared<SteadyClock>());
      perception_ = std::make_unique<Perception>(mission_, *modules_, Budget{.cancel = &is_cancelled_});
    }
    return *perception_;
  }
  static Observation observation(std::size_t readings, double x_m = 0.0) {
    Observation seen;
    seen.T_odom_robot = {x_m, 0.0, 0.0};
    seen.ranges.resize(readings, still::nothing_ahead());
    return seen;
  }
  static std::vector<std::size_t> kinds_of(const Recognition& recognised) {
    std::vector<std::size_t> kinds;
    for (const Event& event : recognised.events) kinds.push_back(event.index());
    return kinds;
  }

  Mission mission_ = still::mission(10);
  MissionModules built_;
  const std::shared_ptr<OffsetLocalizer> localizer_ = std::make_shared<OffsetLocalizer>();
  const std::shared_ptr<CountingMapper> mapper_ = std::make_shared<CountingMapper>();
  const std::shared_ptr<ScriptedDetector> detector_ = std::make_shared<ScriptedDetector>();
  std::atomic<bool> is_cancelled_ = false;
  std::unique_ptr<StagedModules> modules_;
  std::unique_ptr<Perception> perception_;
};

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
