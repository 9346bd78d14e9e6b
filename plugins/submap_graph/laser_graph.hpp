// Laser SLAM without a mission: scans in, poses out, the past corrected.
//
// Each scan is laid on the submap under way (LocalMap): that gives the pose in the submap's frame, which never jumps. A
// scan each half metre or quarter of a right angle is a node of the pose graph, tied to the submaps that it is in. With
// sonars (gather_m) a scan has too few echoes for that: odometry ties each node to the one before, and the echoes of
// some metres of the way are searched in submaps together.
// Closures tie nodes to finished submaps; a solution moves the nodes, and all that hangs on them.
//
// Searching and solving (BackEnd) go on in a thread of their own, while scans come. The answer is taken kAnswerAfter_s
// later by the scans' stamps, and waited for if it is late: the same scans give the same poses to the last bit.
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "maps/submaps/submap.hpp"
#include "plugins/submap_graph/back_end.hpp"
#include "plugins/submap_graph/config.hpp"
#include "plugins/submap_graph/earlier_part.hpp"
#include "plugins/submap_graph/gathered_echoes.hpp"
#include "plugins/submap_graph/local_map.hpp"
#include "plugins/submap_graph/marker_closures.hpp"

namespace cairn::submap_graph {

class LaserGraph {
 public:
  static constexpr double kAnswerAfter_s = 0.2;
  static constexpr int kAnswerAfterScans = 50;  // at the latest, whatever the stamps

  // closer: null: no loop is closed by a search. earlier: what runs before this one have left. Its nodes are the first
  // ones, and stay where they are; its submaps are searched as those of this run are.
  LaserGraph(const Config& config, const Pose2& T_map_start, std::shared_ptr<LoopCloser> closer,
             const Compass& compass = {}, EarlierPart earlier = {});
  LaserGraph(LaserGraph&&) = default;
  ~LaserGraph();

  // A scan as seen from the robot. Where the robot is.
  Pose2 add(std::span<const Point> points_m, const Pose2& T_odom_robot, double stamp_s,
            std::optional<double> compass_rad = {});
  // Between two scans. Where the robot is, by odometry since the last one; there must have been one.
  Pose2 pass(const Pose2& T_odom_robot, double stamp_s);
  // Seen at the scan that was added last.
  void see(const MarkerSighting& sighting);
  // After the last scan, until it returns false: searches closures of all nodes with all submaps, some nodes a call,
  // and solves for the last time.
  bool finish_part();

  // Of all scans of this run, as known now.
  [[nodiscard]] std::vector<Pose2> poses() const;
  // Rises whenever earlier poses have been corrected.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  // Of the latest scan in the map.
  [[nodiscard]] const Eigen::Matrix3d& covariance() const { return covariance_; }
  [[nodiscard]] double matched_ratio() const { return matched_ratio_; }
  [[nodiscard]] std::size_t nodes() const { return T_map_node_.size(); }
  [[nodiscard]] const Pose2& T_map(std::size_t node) const { return T_map_node_[node]; }
  // Without the latest nodes; waits for what is under way.
  [[nodiscard]] const TiedGraph& graph() const;
  [[nodiscard]] const LocalMap& local_map() const { return local_map_; }

 private:
  struct Scan {
    std::size_t node = 0;
    Pose2 T_node_scan;
  };
  struct Search {
    std::future<Correction> answer;
    double begun_s = 0.0;
    int scans = 0;  // since then
  };
  Pose2 place(std::span<const Point> points_m, const Pose2& T_odom_robot);
  void take_node(const Pose2& step, std::span<const Point> points_m, const LocalPose& local);
  [[nodiscard]] std::vector<LocalMap::Tie> ties(const Pose2& step) const;
  [[nodiscard]] FinishedSubmaps all_submaps() const;
  void take_answer_when_due(double stamp_s);
  void take(const Correction& correction);
  void begin_search(double stamp_s);
  void finish_search();
  [[nodiscard]] Eigen::Matrix3d covariance_in_map(const LocalPose& local) const;
  [[nodiscard]] Pose2 T_map(const Scan& scan) const { return T_map_node_[scan.node] * scan.T_node_scan; }

  Config config_;
  EarlierPart earlier_;
  LocalMap local_map_;
  MarkerClosures marker_closures_;
  GatheredEchoes gathered_;
  std::vector<Scan> scans_;  // and what was passed between them
  Pose2 T_odom_robot_;       // at the last of them
  std::optional<double> compass_rad_;
  std::vector<Pose2> T_map_node_;
  double driven_m_ = 0.0;  // to the latest node
  double trusted_at_m_ = 0.0;
  double start_drift_m_;      // until then
  std::size_t finished_ = 0;  // submaps that the back end knows
  std::uint64_t revision_ = 0;
  std::size_t finished_nodes_ = 0;
  bool is_finished_ = false;
  Pose2 T_map_start_;
  Pose2 T_local_node_;  // of the latest node, never corrected
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  double matched_ratio_ = 0.0;
  std::unique_ptr<BackEnd> back_end_;  // not touched while a search is under way
  Stretch stretch_;                    // that it does not know yet
  std::optional<Search> search_;       // last: its thread uses the back end
};

}  // namespace cairn::submap_graph
