// Scans laid on the submap under way. Two submaps are open: the older one is matched against, the newer one, begun half
// a submap later, replaces it when the older one is as long as a submap; so there is always half a submap to match
// with.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "maps/submaps/submap.hpp"
#include "plugins/submap_graph/config.hpp"

namespace cairn::submap_graph {

// Where a scan is, in the frame of the older open submap.
struct LocalPose {
  Pose2 T_submap_robot;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  // in the submap's frame; odometry is part of it
  double matched_ratio = 0.0;
};

class LocalMap {
 public:
  explicit LocalMap(const Config& config) : config_(config) {}

  // The scan as seen from the robot. Adds nothing to the submaps.
  [[nodiscard]] LocalPose match(std::span<const Point> points_m, const Pose2& T_odom_robot);
  // Makes the scan just matched part of the open submaps, as this node; opens and finishes submaps.
  void add_node(std::size_t node, std::span<const Point> points_m, const LocalPose& local);

  // Of a step of odometry, in the frame in which it begins at this pose.
  [[nodiscard]] Eigen::Matrix3d step_information(const Pose2& T_submap_before, const Pose2& step) const;
  // In the order in which they were begun; the open ones are last.
  [[nodiscard]] const std::vector<std::shared_ptr<const Submap>>& submaps() const { return submaps_; }
  [[nodiscard]] std::size_t finished() const { return older_; }
  // Where the latest node is in the older open submap.
  [[nodiscard]] Pose2 T_older_node() const { return T_older_node_.value_or(Pose2{}); }
  // Of the latest node.
  struct Tie {
    std::size_t anchor = 0;
    Pose2 T_anchor_node;
    Eigen::Matrix3d information;  // in the anchor's frame
  };
  [[nodiscard]] const std::vector<Tie>& ties() const { return ties_; }

 private:
  [[nodiscard]] Alignment aligned_with_older(std::span<const Point> points_m, const PosePrediction& odometry);
  void begin_submap(std::size_t node);

  Config config_;
  std::vector<std::shared_ptr<const Submap>> submaps_;
  std::vector<std::shared_ptr<Submap>> open_;  // the older and the newer
  std::size_t older_ = 0;                      // among all submaps
  std::vector<Pose2> T_older_open_;
  std::vector<double> driven_m_;       // in each open one
  std::optional<Pose2> T_odom_robot_;  // of the latest scan
  Pose2 T_older_robot_;
  std::optional<Pose2> T_older_node_;  // of the latest node
  std::vector<Tie> ties_;
  std::optional<FieldPyramid> field_;  // of the older one, until it changes
};

}  // namespace cairn::submap_graph
