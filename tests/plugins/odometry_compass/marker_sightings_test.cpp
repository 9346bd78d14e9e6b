#include "plugins/odometry_compass/marker_sightings.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "plugins/odometry_compass/odometry_compass.hpp"

namespace cairn::odometry_compass {
namespace {

constexpr MarkerId kSeven{MarkerFamily::tag36h11, 7};
const Pose2 kT_map_marker{3.0, 1.0, radians(180.0)};

LandmarkGraph graph_with_marker() {
  LandmarkGraph graph;
  Landmark landmark;
  landmark.marker = kSeven;
  landmark.T_map_landmark = kT_map_marker;
  graph.add(landmark);
  return graph;
}

MarkerSighting seen_from(const Pose2& T_map_robot) {
  MarkerSighting sighting;
  sighting.marker = kSeven;
  sighting.pose.T_robot_marker = inverse(T_map_robot) * kT_map_marker;
  sighting.pose.covariance = Eigen::Vector3d(4e-4, 4e-4, 4e-4).asDiagonal();
  return sighting;
}

PoseEstimate pose_with(const Pose2& T_map_robot, double position_m, double heading_rad) {
  PoseEstimate pose;
  pose.T_map_robot = T_map_robot;
  pose.covariance =
      Eigen::Vector3d(position_m * position_m, position_m * position_m, heading_rad * heading_rad).asDiagonal();
  return pose;
}

TEST(MarkerSightings, AMarkerCorrectsARobotThatKnowsLessThanWhenItFoundIt) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph none;
  const LandmarkGraph known = graph_with_marker();
  MarkerSightings sightings;
  Observation observation;
  (void)sightings.look(observation, pose_with({}, 0.02, 0.01), {grid, none});
  (void)sightings.look(observation, pose_with({}, 0.05, 0.02), {grid, known});  // found
  observation.markers = {seen_from({1.0, 0.5, 0.1})};
  EXPECT_TRUE(sightings.look(observation, pose_with({1.0, 0.5, 0.1}, 0.04, 0.01), {grid, known}).empty());
  const auto seen = sightings.look(observation, pose_with({1.2, 0.5, 0.1}, 0.2, 0.05), {grid, known});
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].T_map_landmark, kT_map_marker);
  EXPECT_NEAR(seen[0].covariance(0, 0), 4e-4 + 0.05 * 0.05, 1e-9) << "what the robot did not know then";
}

TEST(MarkerSightings, MarkersOfASavedMapAreWellKnownAndTheRightOfTwoPosesIsTaken) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph known = graph_with_marker();
  MarkerSightings sightings;
  Observation observation;
  MarkerSighting sighting = seen_from({1.0, 0.5, 0.1});
  const MarkerPose right = sighting.pose;
  sighting.mirrored = right;
  sighting.pose.T_robot_marker.theta_rad += 0.7;
  observation.markers = {sighting};
  const auto seen = sightings.look(observation, pose_with({1.1, 0.5, 0.1}, 0.1, 0.04), {grid, known});
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].T_robot_landmark, right.T_robot_marker);
  EXPECT_LT(seen[0].covariance(0, 0), 0.002);
}

// A robot that drives to and fro beside a marker; odometry alone would lose its way.
TEST(OdometryCompass, MarkersKeepItsDriftBoundAndItsCovarianceHonest) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph known = graph_with_marker();
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  RobotModel robot;
  robot.has_compass = false;
  robot.odometry_error = {0.05, 0.0, radians(3.0)};
  double nees = 0.0;
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    OdometryCompass localizer({}, robot, {0.0, 0.0, 0.0});
    Pose2 truth;
    Observation observation;
    PoseEstimate estimate = localizer.update(observation, {grid, known});
    for (int step = 0; step < 400; ++step) {
      const Pose2 moved{step / 100 % 2 == 0 ? 0.02 : -0.02, 0.0, 0.0};
      truth = truth * moved;
      const Pose2 counted{moved.x_m + 0.05 * std::sqrt(0.02) * normal(random), 0.0,
                          radians(3.0) * std::sqrt(0.02) * normal(random)};
      observation.T_odom_robot = observation.T_odom_robot * counted;
      observation.stamp_s += 0.1;
      observation.markers.clear();
      if (step % 10 == 9) {
        MarkerSighting sighting = seen_from(truth);
        sighting.pose.T_robot_marker.x_m += 0.02 * normal(random);
        sighting.pose.T_robot_marker.y_m += 0.02 * normal(random);
        sighting.pose.T_robot_marker.theta_rad += 0.02 * normal(random);
        observation.markers = {sighting};
      }
      estimate = localizer.update(observation, {grid, known});
    }
    const Eigen::Vector3d error(estimate.T_map_robot.x_m - truth.x_m, estimate.T_map_robot.y_m - truth.y_m,
                                wrap_angle(estimate.T_map_robot.theta_rad - truth.theta_rad));
    EXPECT_LT(error.head<2>().norm(), 0.15);
    nees += error.dot(estimate.covariance.ldlt().solve(error));
  }
  EXPECT_LT(nees / kRuns, 3.6);
}

}  // namespace
}  // namespace cairn::odometry_compass
