// Laser SLAM without a mission: scans in, poses out, the past corrected.
//
// Each scan is laid on the submap under way (LocalMap): that gives the pose in the submap's frame, which never jumps. A
// scan each half metre or quarter of a right angle is a node of the pose graph, tied to the submaps that it is in. With
// sonars (gather_m) a scan has too few echoes for that: odometry ties each node to the one before, and the echoes of
// some metres of the way are searched in submaps together.
// Closures tie nodes to finished submaps; a solution moves the nodes, and all that hangs on them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "maps/pose_graph/pose_graph.hpp"
#include "maps/submaps/submap.hpp"
#include "plugins/submap_graph/closures.hpp"
#include "plugins/submap_graph/config.hpp"
#include "plugins/submap_graph/gathered_echoes.hpp"
#include "plugins/submap_graph/local_map.hpp"
#include "plugins/submap_graph/marker_closures.hpp"

namespace cairn::submap_graph {

class LaserGraph {
 public:
  LaserGraph(const Config& config, const Pose2& T_map_start);

  // A scan as seen from the robot. Where the robot is.
  Pose2 add(std::span<const Point> points_m, const Pose2& T_odom_robot);
  // Seen at the scan that was added last.
  void see(const MarkerSighting& sighting);
  // After the last scan, until it returns false: searches closures of all nodes with all submaps, some nodes a call,
  // and solves for the last time.
  bool finish_part();

  // Of all scans so far, as known now.
  [[nodiscard]] std::vector<Pose2> poses() const;
  // Rises whenever earlier poses have been corrected.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  // Of the latest scan in the map.
  [[nodiscard]] const Eigen::Matrix3d& covariance() const { return covariance_; }
  [[nodiscard]] double matched_ratio() const { return matched_ratio_; }
  [[nodiscard]] const TiedGraph& graph() const { return graph_; }
  [[nodiscard]] const LocalMap& local_map() const { return local_map_; }

 private:
  struct Scan {
    std::size_t node = 0;
    Pose2 T_node_scan;
  };
  void take_node(std::size_t node, std::span<const Point> points_m, const LocalPose& local);
  void tie(std::size_t node, const Pose2& step);
  void solve();
  [[nodiscard]] Eigen::Matrix3d covariance_in_map(const LocalPose& local) const;
  [[nodiscard]] std::span<const std::shared_ptr<const Submap>> finished() const;
  [[nodiscard]] Pose2 T_map(const Scan& scan) const { return graph_.T_map(scan.node) * scan.T_node_scan; }

  Config config_;
  LocalMap local_map_;
  TiedGraph graph_;
  Closer closer_;
  MarkerClosures marker_closures_;
  GatheredEchoes gathered_;
  std::vector<Scan> scans_;
  std::uint64_t revision_ = 0;
  std::size_t solved_at_node_ = 0;
  std::size_t finished_nodes_ = 0;
  bool is_finished_ = false;
  std::size_t solved_closures_ = 0;
  Pose2 T_map_start_;
  Pose2 T_local_node_;  // of the latest node, never corrected
  Pose2 step_;          // to it, from the one before
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  double matched_ratio_ = 0.0;
};

}  // namespace cairn::submap_graph
