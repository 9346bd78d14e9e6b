// Localizer: odometry for the way, compass for the heading, known landmarks against the drift.
//
// Promises a covariance that is honest for the errors the robot's file states (METHOD 11): white and
// constant odometry errors, white compass noise, and a compass bias that wanders from place to place.
// The first observation's odometry is the reference; whatever it says is the start pose. Rules:
//   odometry that is not finite, or   the step is skipped, the next one counts from the last good one
//   beyond 1000 km
//   no compass, or not finite         odometry alone
//   compass beyond the gate           refused; after `compass_refusals` in a row it is believed
//   landmark beyond the gate          refused (the wrong landmark, most likely)
//   landmark not finite, or without   refused
//   a symmetric, positive definite
//   covariance
// Landmarks are taken in the order given, after the compass.
#pragma once

#include <optional>
#include <span>

#include "framework/contracts/localizer.hpp"
#include "framework/contracts/robot_model.hpp"
#include "plugins/odometry_compass/config.hpp"
#include "plugins/odometry_compass/pose_filter.hpp"
#include "plugins/odometry_compass/wall_finder.hpp"

namespace cairn::odometry_compass {

class OdometryCompass final : public Localizer {
 public:
  OdometryCompass(const Config& config, const RobotModel& robot, const Pose2& T_map_start);

  PoseEstimate update(const Observation& observation, std::span<const LandmarkSighting> sightings) override;

 private:
  void follow_odometry(const Pose2& T_odom_robot);
  void follow_compass(double compass_rad);
  int follow_walls(const Observation& observation);
  bool follow_landmark(const LandmarkSighting& sighting);
  [[nodiscard]] bool correct_by(const LandmarkSighting& sighting);

  Config config_;
  MotionNoise motion_noise_;
  double compass_noise_rad_;
  PoseFilter filter_;
  WallFinder wall_finder_;
  std::optional<Pose2> T_odom_robot_;  // the last good one
  int refused_in_a_row_ = 0;           // of the compass
  int refused_places_ = 0;             // sightings in a row that would all move the robot by about the same
  Point refused_off_m_{0.0, 0.0};
};

}  // namespace cairn::odometry_compass
