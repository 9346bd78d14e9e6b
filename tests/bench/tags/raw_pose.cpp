#include "tests/bench/tags/raw_pose.hpp"

#include <apriltag/apriltag_pose.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <new>

namespace cairn {
namespace {

// Debian's library keeps what makes and frees matrices to itself: they are single blocks of malloc().
using Matrix = std::unique_ptr<matd_t, void (*)(void*)>;

Matrix matrix_3x3() {
  auto* const matrix = static_cast<matd_t*>(std::calloc(1, sizeof(matd_t) + 9 * sizeof(double)));
  if (matrix == nullptr) throw std::bad_alloc();
  matrix->nrows = 3;
  matrix->ncols = 3;
  return {matrix, std::free};
}

// As the detector's: from a square of side 2 to the picture.
Matrix homography_of(const apriltag_detection_t& detection) {
  constexpr double kAcross[] = {-1.0, 1.0, 1.0, -1.0};
  constexpr double kDown[] = {1.0, 1.0, -1.0, -1.0};
  Eigen::Matrix<double, 8, 8> left = Eigen::Matrix<double, 8, 8>::Zero();
  Eigen::Matrix<double, 8, 1> right;
  for (int i = 0; i < 4; ++i)
    for (const int axis : {0, 1}) {
      const int row = 2 * i + axis;
      const double seen = detection.p[i][axis];
      left.block<1, 3>(row, 3 * axis) << kAcross[i], kDown[i], 1.0;
      left.block<1, 2>(row, 6) << -seen * kAcross[i], -seen * kDown[i];
      right[row] = seen;
    }
  const Eigen::Matrix<double, 8, 1> solved = left.fullPivLu().solve(right);
  Matrix homography = matrix_3x3();
  for (int k = 0; k < 8; ++k) homography->data[k] = solved[k];
  homography->data[8] = 1.0;
  return homography;
}

}  // namespace

RawPose raw_pose_of(const CameraModel& camera, double size_m, const std::array<Pixel, 4>& corners) {
  constexpr double kHalf_px = 0.5;  // the library counts from the corner of the first pixel
  apriltag_detection_t detection{};
  for (std::size_t i = 0; i < 4; ++i) {
    detection.p[i][0] = corners[i].x() + kHalf_px;
    detection.p[i][1] = corners[i].y() + kHalf_px;
  }
  const Matrix homography = homography_of(detection);
  detection.H = homography.get();
  apriltag_detection_info_t info{&detection,
                                 size_m,
                                 camera.focal_x_px,
                                 camera.focal_y_px,
                                 camera.centre_x_px + kHalf_px,
                                 camera.centre_y_px + kHalf_px};
  apriltag_pose_t pose{};
  estimate_tag_pose(&info, &pose);
  const Matrix turn(pose.R, std::free);
  const Matrix shift(pose.t, std::free);
  // Its camera has x to the right, y down and z ahead; its tag's z looks into the wall.
  const Pose2 T_camera_marker{MATD_EL(shift, 2, 0), -MATD_EL(shift, 0, 0),
                              std::atan2(MATD_EL(turn, 0, 2), -MATD_EL(turn, 2, 2))};
  return {camera.T_robot_camera * T_camera_marker, camera.height_m - MATD_EL(shift, 1, 0)};
}

}  // namespace cairn
