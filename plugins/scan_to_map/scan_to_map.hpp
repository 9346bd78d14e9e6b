// Localizer: odometry for the way, and each scan of a laser laid on the map of the scans before it.
//
// For logs and robots without a compass. Keeps a map of its own, of the echoes' points (PointMap), so
// it depends on no map module. Each scan: odometry predicts the pose; Gauss-Newton moves it so that the
// echoes lie on the lines of the map near them (point to line, errors beyond a few range_noise_m weigh
// less, odometry's own uncertainty holds on to the prediction); then the echoes join the map. Rules:
//   odometry that is not finite, or     the step is skipped, the next one counts from the last good one
//   beyond 1000 km
//   readings of wide beams (sonars),    left out
//   no echoes, bad readings
//   fewer echoes on lines than          odometry alone
//   min_pairs
//   a correction that odometry rules    odometry alone, and the echoes do not join the map
//   out
// The compass and the known map are not used. The covariance holds the start's uncertainty and the
// map's drift besides the match's own: agreement with the map is no agreement with the world. Allocates only where its
// map grows.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "framework/contracts/localizer.hpp"
#include "framework/contracts/robot_model.hpp"
#include "plugins/scan_to_map/config.hpp"
#include "plugins/scan_to_map/point_map.hpp"

namespace cairn::scan_to_map {

class ScanToMap final : public Localizer {
 public:
  ScanToMap(const Config& config, const RobotModel& robot, const Pose2& T_map_start);

  PoseEstimate update(const Observation& observation, const KnownMap& known) override;

 private:
  struct Normal {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    int pairs = 0;
  };
  void predict(const Pose2& T_odom_robot);
  void gather_points(const Observation& observation);
  bool correct();  // false: this scan lies nowhere near the map, and must not join it
  [[nodiscard]] Normal compare(const Pose2& T_map_robot) const;
  void extend_map();
  [[nodiscard]] PoseEstimate estimate() const;

  Config config_;
  double distance_ratio_;
  double heading_rad_per_m_;
  Pose2 T_map_robot_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();  // within the map
  double driven_m_ = 0.0;
  std::optional<Pose2> T_odom_robot_;  // the last good one
  std::vector<Point> points_m_;        // of this scan, from the robot
  PointMap map_;
};

}  // namespace cairn::scan_to_map
