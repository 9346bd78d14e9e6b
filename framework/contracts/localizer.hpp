// Localizer: from observations to where the robot is.
#pragma once

#include <Eigen/Core>
#include <span>

#include "framework/contracts/module_context.hpp"
#include "framework/contracts/observation.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

struct PoseEstimate {
  Pose2 T_map_robot;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // x_m, y_m, theta_rad
  // With this observation: known things seen again that have corrected the pose, and that were too far off for it.
  int sightings_used = 0;
  int sightings_refused = 0;
};

// A known landmark seen again in fresh readings.
struct LandmarkSighting {
  LandmarkId landmark = 0;
  Pose2 T_map_landmark;    // as it was when it became known
  Pose2 T_robot_landmark;  // as just measured
  // Of T_robot_landmark: x_m, y_m, theta_rad. Long in the directions that the readings say nothing of.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

class Localizer {
 public:
  virtual ~Localizer() = default;
  // Numbers that are not finite, or beyond all maps, do not spoil the estimate: it stays finite and its
  // covariance symmetric and positive semi-definite. Hot: no allocation.
  virtual PoseEstimate update(const Observation& observation, std::span<const LandmarkSighting> sightings) = 0;
};

struct LocalizerContext : ModuleContext {
  Pose2 T_map_start{};  // where the robot begins
};

template <>
struct PluginTraits<Localizer> {
  static constexpr PluginKind kKind = PluginKind::localizer;
  using Context = LocalizerContext;
};

}  // namespace cairn
