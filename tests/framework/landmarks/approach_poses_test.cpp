#include "framework/landmarks/approach_poses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/maps/drawn_grid.hpp"

namespace cairn {
namespace {

// Cells of 0.2 m; the robot's disc touches its own cell alone.
constexpr double kSide_m = 0.2;
constexpr double kRadius_m = 0.09;

// Two rooms with a landmark in the wall between them, nearer to the room on the right.
const std::vector<std::string> kTwoRooms{"#################",  //
                                         "#........#......#",  //
                                         "#........#......#",  //
                                         "#.......##......#",  //
                                         "#........#......#",  //
                                         "#################"};

class ApproachPosesTest : public testing::Test {
 protected:
  LandmarkId add_landmark(double x_m, double y_m) {
    Landmark landmark;
    landmark.T_map_landmark = {x_m, y_m, 0.0};
    return graph_.add(landmark);
  }

  void find(const OccupancyGrid& grid, double margin_clearance_m = 0.0) {
    const DistanceField space(grid, UnknownPolicy::avoid);
    const DiscLattice lattice(space, kRadius_m);
    find_approach_poses(graph_, {space, lattice, margin_clearance_m}, driven_, T_map_robot_);
  }

  Point place_of(LandmarkId id) const { return graph_.find(id)->access->position(); }

  LandmarkGraph graph_;
  DrivenPath driven_;
  Pose2 T_map_robot_{-9.0, -9.0, 0.0};  // nowhere
};

TEST_F(ApproachPosesTest, TheNearestFreePlaceFacesTheLandmark) {
  const LandmarkId id = add_landmark(1.95, 0.5);
  find(drawn(kTwoRooms, kSide_m));
  ASSERT_TRUE(graph_.find(id)->access);
  EXPECT_LT((place_of(id) - Point(2.1, 0.5)).norm(), 1e-9);
  EXPECT_NEAR(std::abs(graph_.find(id)->access->theta_rad), std::numbers::pi, 1e-9);
}

TEST_F(ApproachPosesTest, OfTwoRoomsThatOneIsPreferredThatTheRobotHasDrivenIn) {
  const LandmarkId id = add_landmark(1.95, 0.5);
  driven_.record({0.5, 0.9, 0.0});
  find(drawn(kTwoRooms, kSide_m));
  EXPECT_LT(place_of(id).x(), 1.8) << "left of the wall";
}

TEST_F(ApproachPosesTest, WithoutADrivenPathTheRoomOfMostLandmarksIsPreferred) {
  const LandmarkId id = add_landmark(1.95, 0.5);
  add_landmark(0.3, 0.5);
  add_landmark(0.3, 0.9);
  find(drawn(kTwoRooms, kSide_m));
  EXPECT_LT(place_of(id).x(), 1.8);
}

TEST_F(ApproachPosesTest, WhereTheRobotStandsTooTightTheCellsBesideItCount) {
  const LandmarkId id = add_landmark(1.95, 0.5);
  T_map_robot_ = {0.1, 0.5, 0.0};  // inside the outer wall on the left
  find(drawn(kTwoRooms, kSide_m));
  EXPECT_LT(place_of(id).x(), 1.8);
}

TEST_F(ApproachPosesTest, AnApproachPoseStaysWhileNoneIsMuchNearer) {
  const LandmarkId id = add_landmark(1.95, 0.5);
  auto rows = kTwoRooms;
  rows[3][10] = '#';
  find(drawn(rows, kSide_m));
  const Pose2 before = *graph_.find(id)->access;
  ASSERT_GT((before.position() - Point(2.1, 0.5)).norm(), 0.1) << "that cell is occupied";
  graph_.find(id)->T_map_landmark.y_m += 0.02;
  find(drawn(rows, kSide_m));
  EXPECT_EQ(*graph_.find(id)->access, before) << "its heading is hardly off";
  graph_.find(id)->T_map_landmark.y_m -= 0.3;
  find(drawn(rows, kSide_m));
  EXPECT_NE(*graph_.find(id)->access, before) << "the landmark has moved";
  graph_.find(id)->access = Pose2{2.5, 0.5, std::numbers::pi};
  graph_.find(id)->T_map_landmark.y_m = 0.5;
  find(drawn(kTwoRooms, kSide_m));
  EXPECT_LT((place_of(id) - Point(2.1, 0.5)).norm(), 1e-9) << "0.4 m nearer";
}

TEST_F(ApproachPosesTest, TheMarginIsKeptWhereThereIsRoom) {
  const LandmarkId id = add_landmark(1.95, 0.5);
  find(drawn(kTwoRooms, kSide_m), 0.35);
  EXPECT_LT((place_of(id) - Point(2.3, 0.5)).norm(), 1e-9) << "a cell more from the wall";
  find(drawn(kTwoRooms, kSide_m), 9.0);
  EXPECT_LT((place_of(id) - Point(2.1, 0.5)).norm(), 1e-9) << "no room anywhere: the nearest";
}

TEST_F(ApproachPosesTest, WhereNoDiscFitsThereIsNone) {
  const LandmarkId id = add_landmark(1.95, 0.5);
  graph_.find(id)->access = Pose2{2.1, 0.5, 0.0};
  find(drawn({"????????????", "????????????", "????????????"}, kSide_m));
  EXPECT_FALSE(graph_.find(id)->access);
  find(OccupancyGrid(kSide_m));
  EXPECT_FALSE(graph_.find(id)->access);
}

}  // namespace
}  // namespace cairn
