#include "plugins/odometry_compass/odometry_compass.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cairn::odometry_compass {
namespace {

// Further out than any robot gets; squares of what is beyond would drown every covariance.
constexpr double kFarthest_m = 1e6;

bool is_usable(const Pose2& pose) {
  return std::abs(pose.x_m) <= kFarthest_m && std::abs(pose.y_m) <= kFarthest_m && std::isfinite(pose.theta_rad);
}

// A covariance of a position: symmetric, positive definite.
bool is_usable(const Eigen::Matrix2d& c) {
  return c.allFinite() && std::abs(c(0, 1) - c(1, 0)) <= 1e-9 * c.cwiseAbs().maxCoeff() && c(0, 0) > 0.0 &&
         c.determinant() > 0.0;
}

MotionNoise motion_noise_of(const Config& config, const RobotModel& robot) {
  MotionNoise noise;
  noise.along_ratio = std::max(config.least_distance_ratio, robot.odometry_error.distance_ratio);
  noise.across_ratio = config.least_distance_ratio;
  noise.heading_rad_per_m = std::max(config.least_heading_rad_per_m, robot.odometry_error.heading_rad_per_m);
  noise.turn_as_distance_m_per_rad = config.turn_as_distance_m_per_rad;
  noise.bias_rad = config.local_bias_ratio * robot.compass_error.local_bias_rad;
  noise.bias_scale_m = std::max(0.01, robot.compass_error.local_bias_scale_m);
  return noise;
}

}  // namespace

OdometryCompass::OdometryCompass(const Config& config, const RobotModel& robot, const Pose2& T_map_start)
    : config_(config),
      motion_noise_(motion_noise_of(config, robot)),
      compass_noise_rad_(std::max(config.least_compass_noise_rad, robot.compass_error.noise_rad)),
      filter_(T_map_start, {config.start_position_m, config.start_heading_rad, robot.odometry_error.distance_bias_ratio,
                            motion_noise_.bias_rad}) {}

PoseEstimate OdometryCompass::update(const Observation& observation, std::span<const LandmarkSighting> sightings) {
  follow_odometry(observation.T_odom_robot);
  if (config_.use_compass && observation.compass_rad) follow_compass(*observation.compass_rad);
  for (const LandmarkSighting& sighting : sightings) follow_landmark(sighting);
  return filter_.estimate();
}

void OdometryCompass::follow_odometry(const Pose2& T_odom_robot) {
  if (!is_usable(T_odom_robot)) return;
  if (T_odom_robot_) filter_.predict(inverse(*T_odom_robot_) * T_odom_robot, motion_noise_);
  T_odom_robot_ = T_odom_robot;
}

void OdometryCompass::follow_compass(double compass_rad) {
  if (!std::isfinite(compass_rad)) return;
  if (filter_.correct_heading(compass_rad, compass_noise_rad_, config_.compass_gate_sigmas)) {
    refused_in_a_row_ = 0;
    return;
  }
  if (++refused_in_a_row_ < config_.compass_refusals) return;
  filter_.doubt_heading(compass_rad);
  (void)filter_.correct_heading(compass_rad, compass_noise_rad_, config_.compass_gate_sigmas);
  refused_in_a_row_ = 0;
}

void OdometryCompass::follow_landmark(const LandmarkSighting& sighting) {
  const Eigen::Matrix3d& seen = sighting.covariance;
  const bool usable = is_usable(sighting.T_map_landmark) && is_usable(sighting.T_robot_landmark) && seen.allFinite() &&
                      is_usable(Eigen::Matrix2d(seen.topLeftCorner<2, 2>()));
  if (!usable) return;
  const double map_variance = config_.landmark_noise_m * config_.landmark_noise_m;
  const Eigen::Matrix2d noise = seen.topLeftCorner<2, 2>() + map_variance * Eigen::Matrix2d::Identity();
  const bool same_place = filter_.correct_position(
      sighting.T_map_landmark.position(), sighting.T_robot_landmark.position(), noise, config_.landmark_gate_sigmas);
  if (!same_place || !config_.use_landmark_heading || !(seen(2, 2) > 0.0)) return;
  (void)filter_.correct_orientation(sighting.T_map_landmark.theta_rad, sighting.T_robot_landmark.theta_rad,
                                    std::sqrt(seen(2, 2)), config_.landmark_gate_sigmas);
}

}  // namespace cairn::odometry_compass
