// Localizer: from observations to where the robot is.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "framework/contracts/module_context.hpp"
#include "framework/contracts/observation.hpp"
#include "maps/geometry/contour.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_graph.hpp"
#include "maps/submaps/kept_submaps.hpp"

namespace cairn {

// lost: the pose is in a frame of its own that began where the robot was switched on; no map has to do with it yet.
enum class PoseTrust : std::uint8_t { tracking, lost };
[[nodiscard]] constexpr std::string_view name_of(PoseTrust trust) {
  return trust == PoseTrust::lost ? "lost" : "tracking";
}

struct PoseEstimate {
  Pose2 T_map_robot;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // x_m, y_m, theta_rad
  // In this observation: known walls and landmarks seen again that corrected the pose, or were too far off for that.
  int sightings_used = 0;
  int sightings_refused = 0;
  PoseTrust trust = PoseTrust::tracking;  // by the host
};

// What is known of the world before the observation: what earlier ones have mapped, or a saved map.
struct KnownMap {
  const OccupancyGrid& grid;
  const LandmarkGraph& landmarks;
};

// The past of a localizer that corrects it.
class PoseHistory {
 public:
  virtual ~PoseHistory() = default;
  // Where the robot was at each observation that the localizer has got, in their order, by what is known now.
  [[nodiscard]] virtual std::vector<Pose2> poses() const = 0;
  // Rises whenever earlier poses have been corrected.
  [[nodiscard]] virtual std::uint64_t revision() const = 0;
  // After the last observation: a part of the last correction, at most some seconds of it. False: nothing is left.
  virtual bool finish_part() = 0;
};

class Localizer {
 public:
  virtual ~Localizer() = default;
  // Numbers that are not finite, or beyond all maps, do not spoil the estimate: it stays finite and its
  // covariance symmetric and positive semi-definite; nor do landmarks whose places are. Hot: no allocation
  // while the known landmarks stay the same, but for what a history keeps.
  virtual PoseEstimate update(const Observation& observation, const KnownMap& known) = 0;
  // Null: what has been estimated once is never corrected.
  virtual PoseHistory* history() { return nullptr; }
};

// Standard deviations of the start pose, at least; where a localizer knows them to be larger, it takes its own.
struct StartUncertainty {
  double position_m = 0.0;
  double heading_rad = 0.0;
};

class LoopCloser;

struct LocalizerContext : ModuleContext {
  Pose2 T_map_start{};                               // where the robot begins
  std::span<const LandmarkShape> landmark_shapes{};  // the outlines that the mission's templates describe
  StartUncertainty start_uncertainty{};
  // Makes the mission's loop closer, a new one each time; for the time of the call only. Localizers that close no loops
  // do not call it, so have none built. What it throws must pass. Empty: there is none: no loop is closed by a search.
  std::function<std::shared_ptr<LoopCloser>()> loop_closer{};
  // What a localizer that keeps them (PoseGraphReport) has left in the map that the run goes on with; null: nothing. In
  // the map's frame, which stays. For the time of the call only.
  const KeptSubmaps* saved_submaps = nullptr;
};

template <>
struct PluginTraits<Localizer> {
  static constexpr PluginKind kKind = PluginKind::localizer;
  using Context = LocalizerContext;
};

}  // namespace cairn
