// Planar poses and frames: what every room of Cairn means by "where".
//
// Frames are part of names: T_map_robot takes robot coordinates to the map, and in
// T_a_c = T_a_b * T_b_c the letters in the middle must match. Metres, radians, anticlockwise.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn {

using Point = Eigen::Vector2d;  // metres

// Wraps an angle to (-pi, pi].
[[nodiscard]] inline double wrap_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

[[nodiscard]] constexpr double radians(double angle_deg) {
  return angle_deg * std::numbers::pi / 180.0;
}
[[nodiscard]] constexpr double degrees(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

[[nodiscard]] inline Point unit_vector(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}
// Turned by a quarter anticlockwise.
[[nodiscard]] inline Point to_left(const Point& p) {
  return {-p.y(), p.x()};
}
// Positive when b is to the left of a.
[[nodiscard]] inline double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// A rigid motion of the plane. theta_rad is kept in (-pi, pi] by every function below.
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;

  [[nodiscard]] Point position() const { return {x_m, y_m}; }
  [[nodiscard]] Point direction() const { return {std::cos(theta_rad), std::sin(theta_rad)}; }
  bool operator==(const Pose2&) const = default;
};

[[nodiscard]] inline bool is_finite(const Pose2& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.theta_rad);
}

[[nodiscard]] inline Point operator*(const Pose2& T_a_b, const Point& p_b) {
  const double c = std::cos(T_a_b.theta_rad);
  const double s = std::sin(T_a_b.theta_rad);
  return {T_a_b.x_m + c * p_b.x() - s * p_b.y(), T_a_b.y_m + s * p_b.x() + c * p_b.y()};
}

[[nodiscard]] inline Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c) {
  const Point p = T_a_b * T_b_c.position();
  return {p.x(), p.y(), wrap_angle(T_a_b.theta_rad + T_b_c.theta_rad)};
}

[[nodiscard]] inline Pose2 inverse(const Pose2& T_a_b) {
  const double c = std::cos(T_a_b.theta_rad);
  const double s = std::sin(T_a_b.theta_rad);
  return {-c * T_a_b.x_m - s * T_a_b.y_m, s * T_a_b.x_m - c * T_a_b.y_m, wrap_angle(-T_a_b.theta_rad)};
}

// Velocity of a planar robot in its own frame; a differential robot has no sideways part.
struct Twist {
  double v_mps = 0.0;
  double w_radps = 0.0;
  bool operator==(const Twist&) const = default;
};

[[nodiscard]] inline bool is_finite(const Twist& twist) {
  return std::isfinite(twist.v_mps) && std::isfinite(twist.w_radps);
}
// Where a robot is, from where it was, after so many seconds of a constant twist.
[[nodiscard]] inline Pose2 pose_after(const Twist& twist, double time_s) {
  const double turn_rad = twist.w_radps * time_s;
  if (std::abs(turn_rad) < 1e-6) return {twist.v_mps * time_s, 0.0, turn_rad};
  const double radius_m = twist.v_mps / twist.w_radps;
  return {radius_m * std::sin(turn_rad), radius_m * (1.0 - std::cos(turn_rad)), wrap_angle(turn_rad)};
}
// As far towards a value as one step may change it.
[[nodiscard]] constexpr double approached(double from, double to, double max_change) {
  return from + std::clamp(to - from, -max_change, max_change);
}

}  // namespace cairn
