#include "plugins/april_tags/marker_pose.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <utility>

namespace cairn::april_tags {
namespace {

constexpr double kSize_m = 0.16;

struct Standing {
  Pose2 T_robot_marker;
  double height_m = 0.4;
};

std::array<Pixel, 4> corners_of(const CameraModel& camera, const Standing& marker) {
  std::array<Pixel, 4> corners;
  std::size_t i = 0;
  for (const auto& [right, up] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const Point p = marker.T_robot_marker * Point(0.0, 0.5 * kSize_m * right);
    corners[i++] = pixel_of(camera, {p.x(), p.y(), marker.height_m + 0.5 * kSize_m * up}).value();
  }
  return corners;
}

// A lens that looks up from a side of the robot, with distortion.
CameraModel odd_camera() {
  CameraModel camera;
  camera.T_robot_camera = {0.1, -0.2, radians(10.0)};
  camera.tilt_rad = radians(8.0);
  camera.focal_y_px = 500.0;
  camera.centre_x_px = 330.0;
  camera.distortion = {-0.2, 0.05, 0.001, -0.001, 0.0};
  return camera;
}

Eigen::Vector3d error_of(const MarkerPose& pose, const Standing& truth) {
  return {pose.T_robot_marker.x_m - truth.T_robot_marker.x_m, pose.T_robot_marker.y_m - truth.T_robot_marker.y_m,
          wrap_angle(pose.T_robot_marker.theta_rad - truth.T_robot_marker.theta_rad)};
}

double nees_of(const MarkerPose& pose, const Standing& truth) {
  const Eigen::Vector3d error = error_of(pose, truth);
  return error.dot(pose.covariance.ldlt().solve(error));
}

TEST(MarkerPose, ExactCornersGiveTheExactPose) {
  for (const double facing_deg : {140.0, 165.0, 200.0, 235.0})
    for (const double ahead_m : {0.5, 1.5, 3.0}) {
      const Standing truth{{ahead_m, 0.1 * ahead_m, radians(facing_deg)}, 0.5};
      const auto poses = pose_of_square(odd_camera(), kSize_m, corners_of(odd_camera(), truth), {});
      ASSERT_TRUE(poses) << facing_deg << " " << ahead_m;
      EXPECT_LT(error_of(poses->best, truth).norm(), 1e-4) << facing_deg << " " << ahead_m;
      EXPECT_NEAR(poses->best.height_m, 0.5, 1e-4);
      EXPECT_LT(poses->best.reprojection_error_px, 1e-3);
    }
}

// Normalised squared errors average 3 for the pose's three numbers when the covariance is as large as the errors are.
TEST(MarkerPose, ItsCovarianceIsAsLargeAsItsErrors) {
  constexpr double kNoise_px = 0.3;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, kNoise_px);
  for (const double ahead_m : {0.7, 1.5, 3.0}) {
    double sum = 0.0;
    constexpr int kDraws = 400;
    for (int i = 0; i < kDraws; ++i) {
      const Standing truth{{ahead_m, 0.2, radians(i % 2 == 0 ? 220.0 : 145.0)}, 0.4};
      std::array<Pixel, 4> corners = corners_of(CameraModel{}, truth);
      for (Pixel& corner : corners) corner += Pixel(noise(random), noise(random));
      const auto poses = pose_of_square(CameraModel{}, kSize_m, corners, {kNoise_px, 1e-6, 1e-6});
      ASSERT_TRUE(poses);
      double nees = nees_of(poses->best, truth);
      if (poses->mirrored) nees = std::min(nees, nees_of(*poses->mirrored, truth));
      sum += nees;
    }
    EXPECT_GT(sum / kDraws, 1.5) << ahead_m;
    EXPECT_LT(sum / kDraws, 4.0) << ahead_m;
  }
}

TEST(MarkerPose, KeepsBothPosesOfAFarSquareAndOneOfANearOne) {
  const Standing far{{3.0, 0.0, radians(200.0)}, 0.3};
  const auto unsure = pose_of_square(CameraModel{}, kSize_m, corners_of(CameraModel{}, far), {0.3});
  ASSERT_TRUE(unsure && unsure->mirrored);
  EXPECT_NEAR(degrees(wrap_angle(unsure->mirrored->T_robot_marker.theta_rad - unsure->best.T_robot_marker.theta_rad)),
              -40.0, 8.0)
      << "turned to the other side of the line of sight";
  const Standing near{{0.6, 0.0, radians(220.0)}, 0.3};
  const auto sure = pose_of_square(CameraModel{}, kSize_m, corners_of(CameraModel{}, near), {0.3});
  ASSERT_TRUE(sure);
  EXPECT_FALSE(sure->mirrored);
}

TEST(MarkerPose, CornersThatFitWorseThanTheirNoiseWidenTheCovariance) {
  const Standing truth{{1.0, 0.0, radians(200.0)}, 0.3};
  std::array<Pixel, 4> corners = corners_of(CameraModel{}, truth);
  const auto good = pose_of_square(CameraModel{}, kSize_m, corners, {});
  corners[0] += Pixel(3.0, -3.0);
  const auto bad = pose_of_square(CameraModel{}, kSize_m, corners, {});
  ASSERT_TRUE(good && bad);
  EXPECT_GT(bad->best.covariance(2, 2), 10.0 * good->best.covariance(2, 2));
  EXPECT_GT(bad->best.reprojection_error_px, 1.0);
}

TEST(MarkerPose, RefusesWhatIsNoUprightSquare) {
  const std::array<Pixel, 4> diamond{Pixel(300, 260), Pixel(340, 300), Pixel(380, 260), Pixel(340, 220)};
  EXPECT_FALSE(pose_of_square(CameraModel{}, kSize_m, diamond, {})) << "it stands on a corner";
  const std::array<Pixel, 4> upside_down{Pixel(300, 200), Pixel(340, 200), Pixel(340, 240), Pixel(300, 240)};
  EXPECT_FALSE(pose_of_square(CameraModel{}, kSize_m, upside_down, {}));
}

}  // namespace
}  // namespace cairn::april_tags
