#include "plugins/scan_to_map/scan_to_map.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cairn::scan_to_map {
namespace {

// Further out than any robot gets.
constexpr double kFarthest_m = 1e6;
constexpr double kMaxDeviations = 6.0;  // a correction further off than this from odometry is no correction

bool is_usable(const Pose2& pose) {
  return std::abs(pose.x_m) <= kFarthest_m && std::abs(pose.y_m) <= kFarthest_m && std::isfinite(pose.theta_rad);
}

constexpr double squared(double x) {
  return x * x;
}

Eigen::Vector3d between(const Pose2& from, const Pose2& to) {
  return {to.x_m - from.x_m, to.y_m - from.y_m, wrap_angle(to.theta_rad - from.theta_rad)};
}

}  // namespace

ScanToMap::ScanToMap(const Config& config, const RobotModel& robot, const Pose2& T_map_start)
    : config_(config),
      distance_ratio_(std::max(config.min_distance_ratio, robot.odometry_error.distance_ratio)),
      heading_rad_per_m_(std::max(config.min_heading_rad_per_m, robot.odometry_error.heading_rad_per_m)),
      T_map_robot_(T_map_start),
      map_(config.cell_m) {}

PoseEstimate ScanToMap::update(const Observation& observation, const KnownMap&) {
  predict(observation.T_odom_robot);
  gather_points(observation);
  if (correct()) extend_map();
  return estimate();
}

void ScanToMap::predict(const Pose2& T_odom_robot) {
  if (!is_usable(T_odom_robot)) return;
  if (T_odom_robot_) {
    const Pose2 moved = inverse(*T_odom_robot_) * T_odom_robot;
    const Pose2 T_next = T_map_robot_ * moved;
    const double way_m = moved.position().norm() + config_.turn_as_distance_m_per_rad * std::abs(moved.theta_rad);
    Eigen::Matrix3d swing = Eigen::Matrix3d::Identity();  // a heading error moves where the step ends
    swing(0, 2) = -(T_next.y_m - T_map_robot_.y_m);
    swing(1, 2) = T_next.x_m - T_map_robot_.x_m;
    covariance_ = swing * covariance_ * swing.transpose();
    // Standard deviations grow with the way, not its root: errors of neighbouring steps are alike.
    const double place = squared(distance_ratio_ * way_m);
    covariance_.diagonal() += Eigen::Vector3d(place, place, squared(heading_rad_per_m_ * way_m));
    if (is_usable(T_next)) T_map_robot_ = T_next;
    driven_m_ = std::min(driven_m_ + way_m, kFarthest_m);
  }
  T_odom_robot_ = T_odom_robot;
}

void ScanToMap::gather_points(const Observation& observation) {
  points_m_.clear();
  points_m_.reserve(observation.ranges.size());
  for (const RangeReading& reading : observation.ranges) {
    if (reading.half_beam_rad > config_.widest_half_beam_rad || !std::isfinite(reading.range_m)) continue;
    if (reading.range_m < reading.min_m || reading.range_m >= reading.max_m) continue;
    points_m_.push_back(reading.T_robot_sensor * Point(reading.range_m + config_.range_offset_m, 0.0));
  }
}

ScanToMap::Normal ScanToMap::compare(const Pose2& T_map_robot) const {
  Normal sum;
  const double weight = 1.0 / (config_.beams_per_pair * squared(config_.range_noise_m));
  for (const Point& point_m : points_m_) {
    const Point at_m = T_map_robot * point_m;
    const std::optional<Line> line = map_.nearest_line(at_m, config_.pair_m);
    if (!line) continue;
    const double off_m = line->normal.dot(at_m - line->at_m);
    const Point arm_m = at_m - T_map_robot.position();
    const Eigen::Vector3d slope(line->normal.x(), line->normal.y(),
                                line->normal.y() * arm_m.x() - line->normal.x() * arm_m.y());
    const double w = weight / squared(1.0 + squared(off_m / (3.0 * config_.range_noise_m)));  // Geman and McClure
    sum.information += w * slope * slope.transpose();
    sum.gradient += w * off_m * slope;
    ++sum.pairs;
  }
  return sum;
}

bool ScanToMap::correct() {
  constexpr double kStill_m = 1e-6;
  constexpr double kMinVariance = 1e-12;  // a robot that stands still may still be put right
  const Eigen::Matrix3d predicted = covariance_ + kMinVariance * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d held = predicted.inverse();
  Pose2 T_map_robot = T_map_robot_;
  Eigen::Matrix3d information = held;
  for (int i = 0; i < config_.iterations; ++i) {
    const Normal seen = compare(T_map_robot);
    if (seen.pairs < config_.min_pairs) return true;
    const Eigen::Vector3d off = between(T_map_robot_, T_map_robot);
    information = held + seen.information;
    const Eigen::Vector3d step = -information.inverse() * (held * off + seen.gradient);
    if (!step.allFinite()) return false;
    T_map_robot = {T_map_robot.x_m + step.x(), T_map_robot.y_m + step.y(),
                   wrap_angle(T_map_robot.theta_rad + step.z())};
    if (step.cwiseAbs().maxCoeff() < kStill_m) break;
  }
  const Eigen::Vector3d off = between(T_map_robot_, T_map_robot);
  if (!(off.dot(held * off) <= squared(kMaxDeviations)) || !is_usable(T_map_robot)) return false;
  const Eigen::Matrix3d corrected = information.inverse();
  T_map_robot_ = T_map_robot;
  covariance_ = 0.5 * (corrected + corrected.transpose());
  return true;
}

void ScanToMap::extend_map() {
  for (const Point& point_m : points_m_) map_.add(T_map_robot_ * point_m);
}

PoseEstimate ScanToMap::estimate() const {
  const double drift = squared(config_.start_position_m) + squared(config_.drift_ratio * driven_m_);
  Eigen::Matrix3d covariance = covariance_;
  covariance.diagonal() += Eigen::Vector3d(drift, drift, squared(config_.start_heading_rad));
  return {T_map_robot_, covariance};
}

}  // namespace cairn::scan_to_map
