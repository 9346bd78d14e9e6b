// Localizer: from observations to where the robot is.
#pragma once

#include <Eigen/Core>
#include <span>

#include "framework/contracts/module_context.hpp"
#include "framework/contracts/observation.hpp"
#include "maps/geometry/contour.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

struct PoseEstimate {
  Pose2 T_map_robot;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // x_m, y_m, theta_rad
  // In this observation: known walls and landmarks seen again that corrected the pose, or were too far off for that.
  int sightings_used = 0;
  int sightings_refused = 0;
};

// What is known of the world before the observation: what earlier ones have mapped, or a saved map.
struct KnownMap {
  const OccupancyGrid& grid;
  const LandmarkGraph& landmarks;
};

class Localizer {
 public:
  virtual ~Localizer() = default;
  // Numbers that are not finite, or beyond all maps, do not spoil the estimate: it stays finite and its
  // covariance symmetric and positive semi-definite; nor do landmarks whose places are. Hot: no allocation
  // while the known landmarks stay the same.
  virtual PoseEstimate update(const Observation& observation, const KnownMap& known) = 0;
};

struct LocalizerContext : ModuleContext {
  Pose2 T_map_start{};                               // where the robot begins
  std::span<const LandmarkShape> landmark_shapes{};  // the outlines that the mission's templates describe
};

template <>
struct PluginTraits<Localizer> {
  static constexpr PluginKind kKind = PluginKind::localizer;
  using Context = LocalizerContext;
};

}  // namespace cairn
