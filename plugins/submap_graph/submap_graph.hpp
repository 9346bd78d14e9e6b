// Localizer: odometry and laser scans, by a graph of submaps that closes loops and corrects the past (docs/slam.md).
//
// For robots with a laser, with or without a compass. Each scan is laid on the submap under way; places that were
// passed before are proposed by the mission's loop closer, believed with a second witness, and the pose graph is
// solved. Then the pose jumps to where it is in the corrected map, and history() gives the earlier ones. In a run that
// goes on with a saved map, its submaps are searched too, and stay where they are.
//
//   odometry that is not finite, or      the step is taken as none
//   beyond 1000 km
//   readings of wide beams, no echoes,   left out
//   bad readings, far ones
//   nothing to match                     odometry alone
//
// Printed markers tie the places that they are seen from. The compass turns the nodes of the graph, with a bias that is
// found with the poses; without closures only a robot that gathers echoes is turned by it. The known map and other
// landmarks are not used. The covariance is that of the latest match and of the drift since the last closure. The graph
// and its submaps grow with the way, so update() allocates.
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/localizer.hpp"
#include "framework/contracts/optional/pose_graph_report.hpp"
#include "plugins/submap_graph/laser_graph.hpp"
#include "plugins/submap_graph/sweep.hpp"

namespace cairn::submap_graph {

class SubmapGraph final : public Localizer, public PoseHistory, public PoseGraphReport {
 public:
  // closer: null: no loop is closed by a search. robot: whether it has a compass, and what that is worth. saved: what
  // earlier runs have left in the map, or null.
  SubmapGraph(const Config& config, const Pose2& T_map_start, std::shared_ptr<LoopCloser> closer,
              const RobotModel& robot = {}, const KeptSubmaps* saved = nullptr, const StartUncertainty& start = {});

  PoseEstimate update(const Observation& observation, const KnownMap& known) override;
  PoseHistory* history() override { return this; }

  [[nodiscard]] std::vector<Pose2> poses() const override { return graph_.poses(); }
  [[nodiscard]] std::uint64_t revision() const override { return graph_.revision(); }
  bool finish_part() override { return graph_.finish_part(); }
  [[nodiscard]] KeptSubmaps submaps() const override;

 private:
  Config config_;
  Sweep sweep_;
  KeptSubmaps earlier_;  // as it was saved
  LaserGraph graph_;
  std::vector<double> node_stamps_s_;
  std::optional<Pose2> T_odom_robot_;  // the last good one
  std::vector<Point> points_m_;        // of this observation, from the robot
};

// A scan's echoes as points, thinned.
void gather_points(const Observation& observation, const Config& config, std::vector<Point>& points_m);

}  // namespace cairn::submap_graph
