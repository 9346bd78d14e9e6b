// The pose graph of a run: nodes tied to the submaps that they are in, and closures, which may be false and are
// believed only as long as all else agrees with them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "maps/pose_graph/solver.hpp"

namespace cairn::submap_graph {

// A node seen in a submap that it is no part of.
struct Closure {
  std::size_t anchor = 0;
  std::size_t node = 0;
  Pose2 T_anchor_node;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  // in the node's frame
  double score = 0.0;
};

class TiedGraph {
 public:
  // The first node is where it is put; others need ties.
  std::size_t add_node(const Pose2& T_map_node);
  // The nodes so far, which have no ties, stay where they are for good: together they are the map that others are tied
  // to.
  void hold() { held_ = size(); }
  [[nodiscard]] std::size_t held() const { return held_; }
  // Measured in the anchor's frame, with the information there; the node is none that is held.
  void tie(std::size_t anchor, std::size_t node, const Pose2& T_anchor_node, const Eigen::Matrix3d& information,
           bool is_odometry = false);
  void add(const Closure& closure);
  // A heading may have a bias of its group, and of the run.
  void add_heading(const HeadingPrior& heading) { graph_.headings.push_back(heading); }
  void expect_compass(double bias_rad, double local_bias_rad, double local_kept_ratio);
  // Of lengths and turns that the wheels count.
  void expect_odometry(double length_ratio, double turn_ratio);
  // Finds the poses that fit the ties and the closures best. Closures that do not fit are left out of it, the worst
  // first, until they do. When ties do not fit any more, or newer closures push out earlier ones, the closures since
  // the last solution are given up, and nothing has moved. Whether poses have moved.
  bool solve();

  [[nodiscard]] std::size_t size() const { return graph_.T_map_node.size(); }
  [[nodiscard]] const Pose2& T_map(std::size_t node) const { return graph_.T_map_node[node]; }
  [[nodiscard]] const std::vector<Closure>& closures() const { return closures_; }
  [[nodiscard]] const std::vector<bool>& is_believed() const { return is_believed_; }
  [[nodiscard]] const std::vector<PoseEdge>& ties() const { return graph_.edges; }
  [[nodiscard]] std::size_t believed() const;
  [[nodiscard]] bool has_headings() const { return !graph_.headings.empty(); }
  // Of compass and wheels, by the last solution.
  [[nodiscard]] const SensorErrors& errors() const { return graph_.errors; }

 private:
  // Whether ties do not fit, or more closures that were believed before do not than newer ones do.
  [[nodiscard]] bool is_broken(const std::vector<bool>& believed, const PoseGraphSolution& solution) const;
  [[nodiscard]] PoseGraphSolution solved_with(const std::vector<bool>& believed, std::vector<Pose2> T_map_node) const;
  // With the held nodes as one, the map.
  [[nodiscard]] PoseEdge seen_from_map(PoseEdge edge) const;
  [[nodiscard]] PoseGraphSolution solved_in_map(const PoseGraph& whole) const;

  PoseGraph graph_;  // nodes and ties
  std::size_t held_ = 0;
  std::vector<Closure> closures_;
  std::vector<bool> is_believed_;
  std::size_t solved_ = 0;  // so many closures were part of the last solution
};

}  // namespace cairn::submap_graph
