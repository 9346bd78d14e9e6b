// The pose graph of a run: nodes tied to the submaps that they are in, and closures, which may be false and are
// believed only as long as all else agrees with them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "maps/pose_graph/pose_graph.hpp"

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
  void tie(std::size_t anchor, std::size_t node, const Pose2& T_anchor_node, const Eigen::Matrix3d& information);
  void add(const Closure& closure);
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

 private:
  // Whether ties do not fit, or more closures that were believed before do not than newer ones do.
  [[nodiscard]] bool is_broken(const std::vector<bool>& believed, const std::vector<Pose2>& T_map_node) const;
  [[nodiscard]] std::vector<Pose2> solved_with(const std::vector<bool>& believed, std::vector<Pose2> T_map_node) const;
  // With the held nodes as one, the map.
  [[nodiscard]] PoseEdge seen_from_map(PoseEdge edge) const;
  [[nodiscard]] std::vector<Pose2> solved_in_map(const std::vector<PoseEdge>& edges,
                                                 std::vector<Pose2> T_map_node) const;

  PoseGraph graph_;  // nodes and ties
  std::size_t held_ = 0;
  std::vector<Closure> closures_;
  std::vector<bool> is_believed_;
  std::size_t solved_ = 0;  // so many closures were part of the last solution
};

// Covariance with a floor: what is measured is never better than that.
[[nodiscard]] Eigen::Matrix3d with_floor(const Eigen::Matrix3d& information, double floor_m, double floor_rad);
// Information over (x, y, theta) as it is in a frame turned by -angle.
[[nodiscard]] Eigen::Matrix3d information_in_turned(const Eigen::Matrix3d& information, double angle_rad);

}  // namespace cairn::submap_graph
