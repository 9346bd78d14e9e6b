#include "plugins/april_tags/marker_pose.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace cairn::april_tags {
namespace {

constexpr double kMaxMisfitRatio = 0.1;  // of a side in the picture: it is turned about its own axis, or is no square
constexpr double kDecides = 12.0;        // by how much the sum of squared errors over their variance must differ
constexpr double kSameDirection_rad = 0.05;

using State = Eigen::Vector4d;  // x_m, y_m, theta_rad, height_m
using Residual = Eigen::Matrix<double, 8, 1>;
using Jacobian = Eigen::Matrix<double, 8, 4>;

struct Square {
  const CameraModel& camera;
  double size_m;
  const std::array<Pixel, 4>& corners;
};

struct Fit {
  State state;
  double squares_px2 = 0.0;
  Jacobian jacobian = Jacobian::Zero();
};

// Nothing: a corner lies behind the lens.
std::optional<Residual> residual_of(const Square& square, const State& state) {
  constexpr int kRight[] = {-1, 1, 1, -1};
  constexpr int kUp[] = {-1, -1, 1, 1};
  const Pose2 T_robot_marker{state[0], state[1], state[2]};
  Residual residual;
  for (int i = 0; i < 4; ++i) {
    const Point p = T_robot_marker * Point(0.0, 0.5 * square.size_m * kRight[i]);
    const std::optional<Pixel> pixel = pixel_of(square.camera, {p.x(), p.y(), state[3] + 0.5 * square.size_m * kUp[i]});
    if (!pixel) return std::nullopt;
    residual.segment<2>(2 * i) = *pixel - square.corners[static_cast<std::size_t>(i)];
  }
  return residual;
}

std::optional<Jacobian> jacobian_at(const Square& square, const State& state) {
  constexpr double kStep = 1e-5;
  Jacobian jacobian;
  for (int i = 0; i < 4; ++i) {
    const State step = kStep * State::Unit(i);
    const std::optional<Residual> after = residual_of(square, state + step);
    const std::optional<Residual> before = residual_of(square, state - step);
    if (!after || !before) return std::nullopt;
    jacobian.col(i) = (*after - *before) / (2.0 * kStep);
  }
  return jacobian;
}

// Levenberg and Marquardt's method.
std::optional<Fit> fit_from(const Square& square, State state) {
  constexpr int kMaxSteps = 40;
  constexpr double kMaxDamping = 1e8;
  std::optional<Residual> residual = residual_of(square, state);
  double damping = 1e-3;
  for (int i = 0; i < kMaxSteps && residual && damping < kMaxDamping; ++i) {
    const std::optional<Jacobian> jacobian = jacobian_at(square, state);
    if (!jacobian) return std::nullopt;
    Eigen::Matrix4d normal = jacobian->transpose() * *jacobian;
    normal.diagonal() *= 1.0 + damping;
    const State step = normal.ldlt().solve(-jacobian->transpose() * *residual);
    const std::optional<Residual> next = residual_of(square, state + step);
    const bool is_better = next && next->squaredNorm() < residual->squaredNorm();
    damping *= is_better ? 0.1 : 10.0;
    if (!is_better) continue;
    state += step;
    residual = next;
    if (step.norm() < 1e-9) break;
  }
  const std::optional<Jacobian> jacobian = jacobian_at(square, state);
  if (!residual || !jacobian || !state.allFinite()) return std::nullopt;
  state[2] = wrap_angle(state[2]);
  return Fit{state, residual->squaredNorm(), *jacobian};
}

// Where it stands if it faces the lens, and by how much its width says that it is turned from there.
struct FirstGuess {
  State facing_lens;
  double turned_rad = 0.0;
};

std::optional<FirstGuess> first_guess(const Square& square) {
  std::array<double, 4> bearing_rad{};
  std::array<double, 4> slope{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d d = direction_of(square.camera, undistorted(square.camera, square.corners[i]));
    bearing_rad[i] = std::atan2(d.y(), d.x());
    slope[i] = d.z() / std::hypot(d.x(), d.y());
  }
  const double rise = 0.5 * (slope[3] - slope[0] + slope[2] - slope[1]);
  const double width_rad =
      0.5 * (wrap_angle(bearing_rad[0] - bearing_rad[1]) + wrap_angle(bearing_rad[3] - bearing_rad[2]));
  if (!(rise > 1e-6) || !(width_rad > 1e-6)) return std::nullopt;
  const double distance_m = square.size_m / rise;
  const double bearing = bearing_rad[0] - 0.5 * width_rad;
  const Pose2 T_robot_marker =
      square.camera.T_robot_camera *
      Pose2{distance_m * std::cos(bearing), distance_m * std::sin(bearing), wrap_angle(bearing + std::numbers::pi)};
  const double height_m = square.camera.height_m + distance_m * 0.25 * (slope[0] + slope[1] + slope[2] + slope[3]);
  const double narrowed = std::clamp(width_rad * distance_m / square.size_m, 0.1, 1.0);
  return FirstGuess{{T_robot_marker.x_m, T_robot_marker.y_m, T_robot_marker.theta_rad, height_m},
                    std::clamp(std::acos(narrowed), 0.2, 1.4)};
}

MarkerPose pose_of(const Fit& fit, const PoseErrors& errors, double more_angle_rad) {
  const double rms_px = std::sqrt(fit.squares_px2 / 4.0);
  const double corner_px = std::max(errors.corner_px, rms_px);
  const Eigen::Matrix4d covariance = corner_px * corner_px * (fit.jacobian.transpose() * fit.jacobian).inverse();
  MarkerPose pose;
  pose.T_robot_marker = {fit.state[0], fit.state[1], fit.state[2]};
  pose.height_m = fit.state[3];
  pose.covariance = covariance.topLeftCorner<3, 3>();
  pose.covariance = (0.5 * (pose.covariance + pose.covariance.transpose())).eval();
  const double position_m2 = errors.min_position_m * errors.min_position_m;
  pose.covariance.diagonal() += Eigen::Vector3d(
      position_m2, position_m2, errors.min_angle_rad * errors.min_angle_rad + more_angle_rad * more_angle_rad);
  pose.reprojection_error_px = rms_px;
  return pose;
}

double side_px(const std::array<Pixel, 4>& corners) {
  return 0.5 * ((corners[3] - corners[0]).norm() + (corners[2] - corners[1]).norm());
}

}  // namespace

std::optional<MarkerPoses> pose_of_square(const CameraModel& camera, double size_m, const std::array<Pixel, 4>& corners,
                                          const PoseErrors& errors) {
  const Square square{camera, size_m, corners};
  const std::optional<FirstGuess> guess = first_guess(square);
  if (!guess) return std::nullopt;
  const auto turned = [&](double by_rad) { return guess->facing_lens + by_rad * State::Unit(2); };
  std::optional<Fit> best = fit_from(square, turned(guess->turned_rad));
  std::optional<Fit> other = fit_from(square, turned(-guess->turned_rad));
  if (!best || (other && other->squares_px2 < best->squares_px2)) std::swap(best, other);
  if (!best || std::sqrt(best->squares_px2 / 4.0) > kMaxMisfitRatio * side_px(corners)) return std::nullopt;
  const double apart_rad = other ? std::abs(wrap_angle(best->state[2] - other->state[2])) : 0.0;
  const bool is_one = apart_rad < kSameDirection_rad;
  MarkerPoses poses{pose_of(*best, errors, is_one ? 0.5 * apart_rad : 0.0), std::nullopt};
  if (!other || is_one) return poses;
  const double variance_px2 = std::max(errors.corner_px * errors.corner_px, best->squares_px2 / 4.0);
  if (other->squares_px2 - best->squares_px2 < kDecides * variance_px2) poses.mirrored = pose_of(*other, errors, 0.0);
  return poses;
}

}  // namespace cairn::april_tags
