#include "framework/landmarks/association/association.hpp"

#include <gtest/gtest.h>

#include "framework/landmarks/tracker.hpp"

namespace cairn {
namespace {

// With the templates of one orientation and half a step beside.
Matching set_at(double x_m, double y_m, const std::string& category, double angle_deg, double degree = 0.8) {
  Matching matching;
  matching.degrees = {{category, degree, radians(angle_deg), {x_m, y_m}}};
  matching.detection = Detection{category, {x_m, y_m, radians(angle_deg)}, degree, {}};
  matching.detection->templates = {{category, radians(angle_deg), degree},
                                   {category, radians(angle_deg + 15.0), degree - 0.05}};
  return matching;
}

// Small enough to stand 0.3 m beside each other, and as large as the project's templates.
class AssociationTest : public testing::Test {
 protected:
  static std::vector<LandmarkShape> shapes(double side_m) {
    return {{"circle", Contour::circle(side_m)},
            {"square", Contour::polygon({{0, 0}, {side_m, 0}, {side_m, side_m}, {0, side_m}})}};
  }
  LandmarkTracker tracker_{{}, RobotModel{}, shapes(0.25)};

  void be_at(double deviation_m) {
    PoseEstimate pose;
    pose.covariance(0, 0) = pose.covariance(1, 1) = deviation_m * deviation_m;
    tracker_.record_pose(pose);
  }
  // The pose error has been corrected and has come back: nothing is known of it any more.
  void go_away_and_come_back(double deviation_m) {
    for (int i = 0; i < 4; ++i) {
      be_at(0.0);
      be_at(deviation_m);
    }
  }
  void see(const Matching& matching, int times = 1) {
    for (int i = 0; i < times; ++i) (void)tracker_.update(matching);
  }
  std::vector<std::string> categories() const {
    std::vector<std::string> all;
    for (const auto& [id, landmark] : tracker_.graph().landmarks()) all.push_back(landmark.category);
    return all;
  }
};

TEST_F(AssociationTest, ASquareAndACircleBesideItStayTwoLandmarks) {
  be_at(0.1);
  see(set_at(0.0, 0.0, "square", 15.0), 5);
  see(set_at(0.3, 0.0, "circle", 0.0), 5);
  see(set_at(0.02, 0.0, "square", 15.0), 3);
  see(set_at(0.29, 0.0, "circle", 0.0), 3);
  EXPECT_EQ(categories(), (std::vector<std::string>{"square", "circle"}));
  EXPECT_EQ(tracker_.graph().find(1)->sightings, 8);
  EXPECT_EQ(tracker_.graph().find(2)->sightings, 8);
}

TEST_F(AssociationTest, ByDistanceAloneTheyAreOne) {
  tracker_ = LandmarkTracker({.association = AssociationRule::distance}, RobotModel{}, shapes(0.25));
  see(set_at(0.0, 0.0, "square", 15.0), 5);
  see(set_at(0.3, 0.0, "circle", 0.0), 5);
  EXPECT_EQ(categories().size(), 1U);
}

TEST_F(AssociationTest, WhereTwoWouldCutIntoEachOtherAnotherCategoryCorrectsTheFirst) {
  tracker_ = LandmarkTracker({}, RobotModel{}, shapes(0.5));
  see(set_at(0.0, 0.0, "square", 15.0, 0.65), 4);
  see(set_at(0.15, 0.0, "circle", 0.0), 1);
  EXPECT_EQ(categories(), std::vector<std::string>{"circle"});
}

TEST_F(AssociationTest, TwinsAreNeitherFusedNorDoubledWhenThePoseShifts) {
  tracker_ = LandmarkTracker({}, RobotModel{}, shapes(0.5));
  be_at(0.3);
  for (int i = 0; i < 5; ++i) {
    see(set_at(0.0, 0.0, "square", 15.0));
    see(set_at(0.7, 0.0, "square", 15.0));
  }
  ASSERT_EQ(tracker_.graph().landmarks().size(), 2U);
  go_away_and_come_back(0.3);
  for (int i = 0; i < 5; ++i) {
    see(set_at(0.3, 0.0, "square", 15.0));
    see(set_at(1.0, 0.0, "square", 15.0));
  }
  EXPECT_EQ(tracker_.graph().landmarks().size(), 2U);
  EXPECT_TRUE(tracker_.candidates().landmarks().empty());
  EXPECT_EQ(tracker_.graph().find(1)->sightings, 10);
  EXPECT_EQ(tracker_.graph().find(2)->sightings, 10);
}

TEST_F(AssociationTest, AnIsolatedLandmarkIsFoundAgainAfterAShiftThatThePoseErrorAllows) {
  tracker_ = LandmarkTracker({}, RobotModel{}, shapes(0.5));
  be_at(0.4);
  see(set_at(0.0, 0.0, "square", 15.0), 5);
  go_away_and_come_back(0.4);
  see(set_at(0.6, 0.0, "square", 15.0), 5);
  EXPECT_EQ(tracker_.graph().landmarks().size(), 1U);
  EXPECT_EQ(tracker_.graph().find(1)->sightings, 10);
}

TEST_F(AssociationTest, ATurnedTwinInPlaceOfALandmarkIsAnother) {
  be_at(0.1);
  see(set_at(0.0, 0.0, "square", 0.0), 5);
  see(set_at(0.26, 0.0, "square", 45.0), 5);
  EXPECT_EQ(tracker_.graph().landmarks().size(), 2U);
  tracker_ = LandmarkTracker({}, RobotModel{}, shapes(0.25));
  be_at(0.1);
  see(set_at(0.0, 0.0, "square", 0.0), 5);
  see(set_at(0.26, 0.0, "square", 0.0), 5);
  EXPECT_EQ(tracker_.graph().landmarks().size(), 1U) << "the same distance, the same templates";
}

TEST_F(AssociationTest, AMatchingWithoutDetectionIsEvidenceButNoNewLandmark) {
  be_at(0.1);
  see(set_at(0.0, 0.0, "square", 15.0), 5);
  Matching undecided = set_at(0.02, 0.0, "square", 15.0);
  undecided.detection.reset();
  see(undecided);
  EXPECT_EQ(tracker_.graph().find(1)->sightings, 5);
  EXPECT_EQ(tracker_.graph().find(1)->evidence[0].matchings, 6);
  undecided.degrees[0].at_m = {3.0, 0.0};
  see(undecided, 5);
  EXPECT_EQ(tracker_.graph().landmarks().size(), 1U);
  EXPECT_TRUE(tracker_.candidates().landmarks().empty());
}

TEST_F(AssociationTest, OneMatchingThatSeesBothSpeaksOfEach) {
  be_at(0.1);
  see(set_at(0.0, 0.0, "square", 15.0), 5);
  see(set_at(0.3, 0.0, "circle", 0.0), 5);
  Matching both = set_at(0.0, 0.0, "square", 15.0);
  both.degrees.push_back({"circle", 0.75, 0.0, {0.3, 0.0}});
  see(both);
  EXPECT_EQ(categories(), (std::vector<std::string>{"square", "circle"}));
  EXPECT_EQ(tracker_.graph().find(1)->evidence.size(), 1U);
  EXPECT_EQ(tracker_.graph().find(2)->evidence[0].matchings, 6);
}

TEST_F(AssociationTest, WhatAnEarlierRunHasKnownIsKnownAgain) {
  be_at(0.1);
  see(set_at(0.0, 0.0, "square", 15.0), 5);
  LandmarkTracker resumed({}, RobotModel{}, shapes(0.25));
  resumed.restore(tracker_.graph(), tracker_.candidates(), {});
  PoseEstimate pose;
  pose.covariance(0, 0) = pose.covariance(1, 1) = 0.04;
  resumed.record_pose(pose);
  (void)resumed.update(set_at(0.25, 0.0, "square", 15.0));
  EXPECT_EQ(resumed.graph().find(1)->sightings, 6);
  EXPECT_TRUE(resumed.candidates().landmarks().empty());
}

TEST_F(AssociationTest, TheSameStreamGivesTheSameGraph) {
  LandmarkTracker other({}, RobotModel{}, shapes(0.25));
  be_at(0.2);
  PoseEstimate pose;
  pose.covariance(0, 0) = pose.covariance(1, 1) = 0.04;
  other.record_pose(pose);
  for (int i = 0; i < 30; ++i) {
    const Matching seen = set_at(0.25 * (i % 4), 0.1 * (i % 3), i % 5 == 0 ? "circle" : "square", 15.0 * (i % 2));
    see(seen);
    (void)other.update(seen);
  }
  EXPECT_EQ(tracker_.graph(), other.graph());
  EXPECT_EQ(tracker_.candidates(), other.candidates());
}

}  // namespace
}  // namespace cairn
