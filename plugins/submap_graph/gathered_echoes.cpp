#include "plugins/submap_graph/gathered_echoes.hpp"

#include <algorithm>

namespace cairn::submap_graph {

void GatheredEchoes::add(std::span<const Point> points_m, const Pose2& T_local_robot) {
  if (way_m_ <= 0.0) return;
  if (has_pose_) driven_m_ += (T_local_robot.position() - T_local_robot_.position()).norm();
  T_local_robot_ = T_local_robot;
  has_pose_ = true;
  for (const Point& point_m : points_m) echoes_.push_back({T_local_robot * point_m, driven_m_});
  fresh_ += points_m.size();
  while (!echoes_.empty() && driven_m_ - echoes_.front().driven_m > way_m_) echoes_.pop_front();
  fresh_ = std::min(fresh_, echoes_.size());
}

const std::vector<Point>& GatheredEchoes::all(const Pose2& T_local_node) {
  return seen_from(T_local_node, 0);
}

const std::vector<Point>& GatheredEchoes::since_last_node(const Pose2& T_local_node) {
  const std::size_t first = echoes_.size() - fresh_;
  fresh_ = 0;
  return seen_from(T_local_node, first);
}

const std::vector<Point>& GatheredEchoes::seen_from(const Pose2& T_local_node, std::size_t first) {
  const Pose2 T_node_local = inverse(T_local_node);
  seen_m_.clear();
  for (std::size_t i = first; i < echoes_.size(); ++i) seen_m_.push_back(T_node_local * echoes_[i].local_m);
  return seen_m_;
}

}  // namespace cairn::submap_graph
