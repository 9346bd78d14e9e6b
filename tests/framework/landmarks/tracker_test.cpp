#include "framework/landmarks/tracker.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Category and degree of what a matching found at a place; without detection when no class was decided.
Matching matching_at(double x_m, double y_m, const std::vector<std::pair<std::string, double>>& degrees,
                     bool is_decided = true) {
  Matching matching;
  for (const auto& [category, degree] : degrees) matching.degrees.push_back({category, degree, 0.0, {x_m, y_m}});
  if (is_decided) matching.detection = Detection{degrees[0].first, {x_m, y_m, 0.0}, degrees[0].second, {}};
  return matching;
}

Matching detection_at(double x_m, double y_m, const std::string& category, double degree) {
  return matching_at(x_m, y_m, {{category, degree}});
}

// Answers every request with the straight line.
class StraightPlanner : public Planner {
 public:
  PlanResult plan(const PlanRequest& request, const WorldView&, const Budget&) const override {
    PlanResult result;
    result.outcome = PlanOutcome::solved;
    result.path = {*request.from.pose, *request.to.pose};
    result.length_m = (request.from.pose->position() - request.to.pose->position()).norm();
    return result;
  }
};

// A free floor of 6 x 4 m with two occupied blocks of 0.4 m at (1.5, 2) and (4.5, 2).
OccupancyGrid floor_with_two_blocks() {
  OccupancyGrid grid(0.1);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      const bool block = y >= 18 && y < 22 && ((x >= 13 && x < 17) || (x >= 43 && x < 47));
      grid.set_log_odds({x, y}, block ? 1000 : -1000);
    }
  return grid;
}

using ChangeKind = LandmarkTracker::ChangeKind;
using Changes = std::vector<std::pair<LandmarkId, ChangeKind>>;

class LandmarkTrackerTest : public testing::Test {
 protected:
  RobotModel robot_;
  LandmarkTracker tracker_{
      {.confirm_sightings = 1}, robot_, {{"square", Contour::polygon({{0, 0}, {0.4, 0}, {0.4, 0.4}, {0, 0.4}})}}};
  OccupancyGrid grid_ = floor_with_two_blocks();

  Changes update(const Matching& matching) {
    Changes changes;
    for (const auto& [id, kind] : tracker_.update(matching)) changes.emplace_back(id, kind);
    return changes;
  }

  void connect() {
    PoseEstimate pose;
    pose.T_map_robot = {3.0, 1.0, 0.0};
    const LandmarkGraph graph = tracker_.graph();
    const WorldView world{grid_, graph, robot_, pose, 0.0, nullptr, 0.0};
    tracker_.connect(
        world, [&](const PlanRequest& request) { return StraightPlanner{}.plan(request, world, {}); }, 1);
  }
};

TEST_F(LandmarkTrackerTest, ADetectionNearALandmarkIsThatLandmark) {
  EXPECT_EQ(update(detection_at(1.5, 2.0, "square", 0.6)), (Changes{{1, ChangeKind::found}}));
  EXPECT_EQ(update(detection_at(1.6, 2.1, "square", 0.5)), Changes{}) << "no better";
  EXPECT_EQ(tracker_.graph().landmarks().size(), 1U);
  EXPECT_EQ(tracker_.graph().find(1)->sightings, 2);
  EXPECT_DOUBLE_EQ(tracker_.graph().find(1)->T_map_landmark.x_m, 1.5);
}

TEST_F(LandmarkTrackerTest, ANameStaysWithTheLandmarkThatAnotherProvesToBe) {
  update(detection_at(1.5, 2.0, "square", 0.6));
  update(detection_at(1.95, 2.0, "square", 0.65));
  EXPECT_TRUE(tracker_.name(2, "desk"));
  EXPECT_FALSE(tracker_.name(7, "desk"));
  EXPECT_EQ(update(detection_at(1.78, 2.0, "square", 0.7)),
            (Changes{{2, ChangeKind::retired}, {1, ChangeKind::changed}}));
  EXPECT_EQ(tracker_.graph().find(1)->name, "desk");
  EXPECT_EQ(tracker_.graph().retired().at(2).reason, "is desk");
}

TEST_F(LandmarkTrackerTest, ABetterDegreeCorrectsThePlaceButKeepsTheId) {
  update(detection_at(1.5, 2.0, "square", 0.6));
  EXPECT_EQ(update(detection_at(1.55, 2.0, "square", 0.8)), (Changes{{1, ChangeKind::changed}}));
  EXPECT_DOUBLE_EQ(tracker_.graph().find(1)->T_map_landmark.x_m, 1.55);
}

TEST_F(LandmarkTrackerTest, TheNewestMatchingCorrectsAnEarlyCategoryEvenWithAWorseDegree) {
  update(detection_at(1.5, 2.0, "triangle", 0.7));
  EXPECT_EQ(update(matching_at(1.55, 2.0, {{"square", 0.66}, {"triangle", 0.62}}, false)),
            (Changes{{1, ChangeKind::changed}}));
  const Landmark& landmark = *tracker_.graph().find(1);
  EXPECT_EQ(landmark.category, "square");
  EXPECT_DOUBLE_EQ(landmark.degree, 0.66);
  EXPECT_DOUBLE_EQ(landmark.T_map_landmark.x_m, 1.55);
  EXPECT_EQ(landmark.sightings, 1) << "a matching that decides nothing is evidence, but no sighting";
  ASSERT_EQ(landmark.evidence.size(), 2U);
  EXPECT_EQ(landmark.evidence[0], (CategoryEvidence{"square", 1, 0.66, 0.66, 0.66}));
  EXPECT_EQ(landmark.evidence[1].matchings, 2);
  EXPECT_DOUBLE_EQ(landmark.evidence[1].mean_degree, 0.66);
  EXPECT_DOUBLE_EQ(landmark.evidence[1].best_degree, 0.7);
  EXPECT_DOUBLE_EQ(landmark.evidence[1].last_degree, 0.62);
}

TEST_F(LandmarkTrackerTest, WhatDoesNotFitIsNoEvidenceHoweverItIsReported) {
  update(detection_at(1.5, 2.0, "triangle", 0.7));
  Matching matching = matching_at(1.55, 2.0, {{"square", 0.5}}, false);
  matching.degrees[0].fits = false;
  EXPECT_EQ(update(matching), Changes{});
  EXPECT_EQ(tracker_.graph().find(1)->category, "triangle");
  EXPECT_EQ(tracker_.graph().find(1)->evidence.size(), 1U);
}

TEST_F(LandmarkTrackerTest, ADetectionFarAwayIsANewLandmark) {
  update(detection_at(1.5, 2.0, "square", 0.6));
  EXPECT_EQ(update(detection_at(4.5, 2.0, "square", 0.6)), (Changes{{2, ChangeKind::found}}));
  EXPECT_EQ(tracker_.graph().landmarks().size(), 2U);
}

TEST_F(LandmarkTrackerTest, WhatIsSeenTooSeldomIsNoLandmark) {
  tracker_ = LandmarkTracker({.confirm_sightings = 3}, robot_, {});
  EXPECT_EQ(update(detection_at(1.5, 2.0, "square", 0.6)), Changes{});
  EXPECT_EQ(update(detection_at(1.55, 2.0, "circle", 0.7)), Changes{});
  EXPECT_EQ(update(detection_at(4.5, 2.0, "square", 0.6)), Changes{}) << "another place, its first sighting";
  EXPECT_EQ(update(matching_at(1.5, 2.0, {{"circle", 0.6}}, false)), Changes{}) << "undecided";
  EXPECT_TRUE(tracker_.graph().landmarks().empty());
  EXPECT_EQ(update(detection_at(1.5, 2.0, "circle", 0.65)), (Changes{{1, ChangeKind::found}}));
  ASSERT_EQ(tracker_.graph().landmarks().size(), 1U);
  const Landmark& landmark = *tracker_.graph().find(1);
  EXPECT_EQ(landmark.category, "circle");
  EXPECT_DOUBLE_EQ(landmark.degree, 0.7) << "its best";
  EXPECT_DOUBLE_EQ(landmark.T_map_landmark.x_m, 1.55);
  EXPECT_EQ(landmark.sightings, 3);
}

TEST_F(LandmarkTrackerTest, LandmarksThatProveToBeOneAreMergedIntoTheOlder) {
  update(detection_at(1.5, 2.0, "square", 0.6));
  update(detection_at(1.95, 2.0, "square", 0.65));
  ASSERT_EQ(tracker_.graph().landmarks().size(), 2U);
  // Nearer to the second, which it moves towards the first.
  EXPECT_EQ(update(detection_at(1.78, 2.0, "square", 0.7)),
            (Changes{{2, ChangeKind::retired}, {1, ChangeKind::changed}}));
  ASSERT_EQ(tracker_.graph().landmarks().size(), 1U);
  const Landmark& landmark = *tracker_.graph().find(1);
  EXPECT_DOUBLE_EQ(landmark.T_map_landmark.x_m, 1.78);
  EXPECT_EQ(landmark.sightings, 3);
  EXPECT_EQ(tracker_.graph().retired().at(2).reason, "is L1");
}

TEST_F(LandmarkTrackerTest, ALandmarkWhosePlaceIsSeenFreeIsRetiredWithItsHistory) {
  update(detection_at(1.5, 2.0, "square", 0.6));
  update(detection_at(4.5, 2.0, "square", 0.6));
  EXPECT_EQ(tracker_.retire_freed(grid_).size(), 0U);
  for (int y = 18; y < 22; ++y)
    for (int x = 13; x < 17; ++x) grid_.set_log_odds({x, y}, x == 13 ? 0 : -1000);
  EXPECT_EQ(tracker_.retire_freed(grid_).size(), 0U) << "three quarters are not enough";
  grid_.set_log_odds({13, 18}, -1000);
  const std::vector<LandmarkTracker::Change> changes = tracker_.retire_freed(grid_);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].landmark, 1);
  EXPECT_EQ(tracker_.graph().landmarks().size(), 1U);
  EXPECT_EQ(tracker_.graph().retired().at(1).reason, "its place has been seen free");
  EXPECT_EQ(tracker_.graph().retired().at(1).landmark.evidence.size(), 1U);
}

TEST_F(LandmarkTrackerTest, ConnectFindsStandingPlacesThatFitTheRobotAndLookAtTheLandmark) {
  update(detection_at(1.5, 2.0, "square", 0.6));
  connect();
  const Landmark& landmark = *tracker_.graph().find(1);
  ASSERT_TRUE(landmark.access);
  const Point to_landmark = landmark.T_map_landmark.position() - landmark.access->position();
  EXPECT_GE(to_landmark.norm(), 0.2 + robot_.radius_m);
  EXPECT_LE(to_landmark.norm(), 0.7);
  EXPECT_NEAR(to_landmark.normalized().dot(landmark.access->direction()), 1.0, 1e-9);
}

TEST_F(LandmarkTrackerTest, PlannedRoutesJoinBothWays) {
  update(detection_at(1.5, 2.0, "square", 0.6));
  update(detection_at(4.5, 2.0, "circle", 0.6));
  connect();
  ASSERT_NE(tracker_.graph().route_between(1, 2), nullptr);
  ASSERT_NE(tracker_.graph().route_between(2, 1), nullptr);
  EXPECT_FALSE(tracker_.graph().route_between(1, 2)->driven);
  EXPECT_EQ(tracker_.graph().routes().size(), 2U);
}

TEST_F(LandmarkTrackerTest, AWayThatTheRobotDroveIsPreferredToAPlannedOne) {
  update(detection_at(1.5, 2.0, "square", 0.6));
  update(detection_at(4.5, 2.0, "circle", 0.6));
  connect();
  const Pose2 from = *tracker_.graph().find(1)->access;
  const Pose2 to = *tracker_.graph().find(2)->access;
  for (double s = 0.0; s <= 1.0; s += 0.01)
    tracker_.record_pose({from.x_m + s * (to.x_m - from.x_m), from.y_m + s * (to.y_m - from.y_m), 0.0});
  connect();
  const Route& route = *tracker_.graph().route_between(1, 2);
  EXPECT_TRUE(route.driven);
  EXPECT_GT(route.trajectory.size(), 20U);
  EXPECT_EQ(route.trajectory, in_whole_steps(route.trajectory));
  EXPECT_EQ(route.trajectory.front(), in_whole_steps({from}).front());
  EXPECT_EQ(route.trajectory.back(), in_whole_steps({to}).front());
}

// The way is bent: its end has been turned and moved, its beginning has not.
class MovedMapTest : public LandmarkTrackerTest {
 protected:
  // Sees a landmark from each of two places.
  void see_two() {
    drive({1.5, 1.0, 0.0});
    (void)update(detection_at(1.5, 2.0, "square", 0.8));
    drive({3.0, 1.0, 0.0});
    drive({4.5, 1.0, 0.0});
    (void)update(detection_at(4.5, 2.0, "square", 0.8));
  }
  void drive(const Pose2& pose) {
    before_.push_back(pose);
    PoseEstimate estimate;
    estimate.T_map_robot = pose;
    tracker_.record_pose(estimate);
  }
  Changes move(const std::vector<Pose2>& after) {
    Changes changes;
    for (const auto& [id, kind] : tracker_.move({before_, after})) changes.emplace_back(id, kind);
    return changes;
  }
  [[nodiscard]] Pose2 place_of(LandmarkId id) const { return tracker_.graph().find(id)->T_map_landmark; }
  [[nodiscard]] static bool are_near(const Pose2& a, const Pose2& b) {
    return (a.position() - b.position()).norm() < 1e-9;
  }

  std::vector<Pose2> before_;
  const std::vector<Pose2> bent_{{1.5, 1.0, 0.0}, {3.0, 1.0, 0.0}, {4.5, 1.5, radians(90.0)}};
};

TEST_F(MovedMapTest, ALandmarkMovesAsThePoseFromWhichItWasPlaced) {
  see_two();
  EXPECT_EQ(move(bent_), (Changes{{2, ChangeKind::changed}}));
  EXPECT_TRUE(are_near(place_of(1), {1.5, 2.0, 0.0}));
  EXPECT_TRUE(are_near(place_of(2), {3.5, 1.5, 0.0})) << "a metre to the left of the robot";
  EXPECT_NEAR(place_of(2).theta_rad, radians(90.0), 1e-9);
  EXPECT_EQ(tracker_.driven_path(), bent_);
  // And from there again.
  before_ = bent_;
  std::vector<Pose2> again = bent_;
  again.back().x_m += 1.0;
  EXPECT_EQ(move(again), (Changes{{2, ChangeKind::changed}}));
  EXPECT_TRUE(are_near(place_of(2), {4.5, 1.5, 0.0}));
}

TEST_F(MovedMapTest, ACandidateMovesTooAndWasPlacedThereWhenItBecomesALandmark) {
  tracker_ = LandmarkTracker({.confirm_sightings = 2}, robot_, {});
  drive({1.0, 1.0, 0.0});
  (void)update(detection_at(1.0, 2.0, "square", 0.8));
  drive({2.0, 1.0, 0.0});
  (void)move({{1.0, 1.5, 0.0}, {2.0, 1.5, 0.0}});
  before_ = {{1.0, 1.5, 0.0}, {2.0, 1.5, 0.0}};
  EXPECT_EQ(update(detection_at(1.0, 2.5, "square", 0.8)), (Changes{{1, ChangeKind::found}}));
  EXPECT_TRUE(are_near(place_of(1), {1.0, 2.5, 0.0}));
  (void)move({{1.0, 1.7, 0.0}, {2.0, 9.0, 0.0}});
  EXPECT_TRUE(are_near(place_of(1), {1.0, 2.7, 0.0}));
}

TEST_F(MovedMapTest, WhatAnEarlierRunHasSeenStays) {
  see_two();
  tracker_.restore(tracker_.graph(), {}, {});
  before_.clear();
  drive({4.5, 1.0, 0.0});
  EXPECT_TRUE(move({{4.5, 2.0, 0.0}}).empty());
  EXPECT_TRUE(are_near(place_of(2), {4.5, 2.0, 0.0}));
}

TEST_F(MovedMapTest, ARouteKeepsItsIdAndEachOfItsPointsMovesAsTheWayNearBy) {
  see_two();
  connect();
  ASSERT_FALSE(tracker_.graph().routes().empty());
  const Route before = tracker_.graph().routes().begin()->second;
  std::vector<Pose2> after = before_;
  for (Pose2& pose : after) pose.y_m += 0.3;
  (void)move(after);
  const Route* const moved = tracker_.graph().find_route(before.id);
  ASSERT_NE(moved, nullptr);
  ASSERT_EQ(moved->trajectory.size(), before.trajectory.size());
  for (std::size_t i = 0; i < before.trajectory.size(); ++i)
    EXPECT_NEAR(moved->trajectory[i].y_m, before.trajectory[i].y_m + 0.3, 2.0 * kMaxRounding_m);
  EXPECT_EQ(tracker_.graph().routes_from(before.from).front(), before.id);
}

}  // namespace
}  // namespace cairn
