#include "plugins/submap_graph/sweep.hpp"

namespace cairn::submap_graph {
namespace {

constexpr double kRounding_s = 1e-6;

}  // namespace

bool Sweep::add(std::span<const Point> points_m, const Pose2& T_odom_robot, double stamp_s) {
  T_odom_robot_ = T_odom_robot;
  stamp_s_ = stamp_s;
  for (const Point& point_m : points_m) points_odom_m_.push_back(T_odom_robot * point_m);
  // The first round is cut short: nobody knows when it began.
  if (!begun_s_) return true;
  const double since_s = stamp_s - *begun_s_;
  return since_s >= duration_s_ - kRounding_s || since_s < 0.0;
}

std::span<const Point> Sweep::take() {
  const Pose2 T_robot_odom = inverse(T_odom_robot_);
  points_m_.clear();
  for (const Point& point_m : points_odom_m_) points_m_.push_back(T_robot_odom * point_m);
  points_odom_m_.clear();
  begun_s_ = stamp_s_;
  return points_m_;
}

}  // namespace cairn::submap_graph
