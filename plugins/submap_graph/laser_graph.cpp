#include "plugins/submap_graph/laser_graph.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cairn::submap_graph {
namespace {

constexpr double kTieFloor_m = 0.015;
constexpr double kTieFloor_rad = radians(0.25);
constexpr std::size_t kNodesInPart = 20;

}  // namespace

LaserGraph::LaserGraph(const Config& config, const Pose2& T_map_start)
    : config_(config), local_map_(config), closer_(config), gathered_(config.gather_m), T_map_start_(T_map_start) {}

Pose2 LaserGraph::add(std::span<const Point> points_m, const Pose2& T_odom_robot) {
  const LocalPose local = local_map_.match(points_m, T_odom_robot);
  matched_ratio_ = local.matched_ratio;
  if (scans_.empty()) {
    graph_.add_node(T_map_start_);
    T_local_node_ = T_map_start_;
    gathered_.add(points_m, T_local_node_);
    take_node(0, points_m, local);
    scans_.push_back({0, Pose2{}});
    return T_map_start_;
  }
  covariance_ = covariance_in_map(local);
  const Pose2 T_node_robot = inverse(local_map_.T_older_node()) * local.T_submap_robot;
  gathered_.add(points_m, T_local_node_ * T_node_robot);
  const std::size_t last = graph_.size() - 1;
  if (T_node_robot.position().norm() < config_.node_m && std::abs(T_node_robot.theta_rad) < config_.node_rad) {
    scans_.push_back({last, T_node_robot});
    return T_map(scans_.back());
  }
  const std::size_t node = graph_.add_node(graph_.T_map(last) * T_node_robot);
  T_local_node_ = T_local_node_ * T_node_robot;
  step_ = T_node_robot;
  scans_.push_back({node, Pose2{}});
  take_node(node, points_m, local);
  return graph_.T_map(node);
}

void LaserGraph::see(const MarkerSighting& sighting) {
  const Scan& scan = scans_.back();
  if (const auto closure = marker_closures_.see(sighting, scan.node, scan.T_node_scan)) graph_.add(*closure);
}

// The match's, and the drift since the last closure: a third of the window's growth, which is of three deviations.
Eigen::Matrix3d LaserGraph::covariance_in_map(const LocalPose& local) const {
  const std::size_t last = graph_.size() - 1;
  const double turn_rad = graph_.T_map(last).theta_rad - local_map_.T_older_node().theta_rad;
  const Eigen::Matrix3d information = with_floor(local.information, kTieFloor_m, kTieFloor_rad);
  Eigen::Matrix3d covariance = information_in_turned(information.inverse(), -turn_rad);
  const double drift_m = config_.drift_ratio / 3.0 * closer_.untied_m(last);
  covariance.diagonal().head<2>().array() += drift_m * drift_m;
  return 0.5 * (covariance + covariance.transpose());
}

void LaserGraph::take_node(std::size_t node, std::span<const Point> points_m, const LocalPose& local) {
  const bool gathers = config_.gather_m > 0.0;
  local_map_.add_node(node, gathers ? gathered_.since_last_node(T_local_node_) : points_m, local);
  tie(node, step_);
  closer_.add_node(gathers ? gathered_.all(T_local_node_) : points_m, T_local_node_);
  for (const Closure& closure : closer_.close(node, graph_, finished())) graph_.add(closure);
  if (graph_.closures().size() <= solved_closures_ ||
      node < solved_at_node_ + static_cast<std::size_t>(config_.solve_every_nodes))
    return;
  solve();
}

void LaserGraph::tie(std::size_t node, const Pose2& step) {
  const auto floored = [](const Eigen::Matrix3d& information) {
    return with_floor(information, kTieFloor_m, kTieFloor_rad);
  };
  if (config_.gather_m <= 0.0) {
    for (const LocalMap::Tie& tie : local_map_.ties())
      graph_.tie(tie.anchor, node, tie.T_anchor_node, floored(tie.information));
  } else if (node > 0) {
    graph_.tie(node - 1, node, step, floored(local_map_.step_information(Pose2{}, step)));
  }
}

std::span<const std::shared_ptr<const Submap>> LaserGraph::finished() const {
  return std::span(local_map_.submaps()).first(local_map_.finished());
}

void LaserGraph::solve() {
  solved_at_node_ = graph_.size() - 1;
  if (graph_.solve()) ++revision_;
  solved_closures_ = graph_.closures().size();
}

bool LaserGraph::finish_part() {
  if (is_finished_) return false;
  const std::size_t end = std::min(finished_nodes_ + kNodesInPart, graph_.size());
  for (; finished_nodes_ < end; ++finished_nodes_)
    for (const Closure& closure : closer_.close_again(finished_nodes_, graph_, std::span(local_map_.submaps())))
      graph_.add(closure);
  if (finished_nodes_ < graph_.size()) return true;
  if (!graph_.closures().empty()) solve();
  is_finished_ = true;
  return false;
}

std::vector<Pose2> LaserGraph::poses() const {
  std::vector<Pose2> T_map_robot;
  T_map_robot.reserve(scans_.size());
  for (const Scan& scan : scans_) T_map_robot.push_back(T_map(scan));
  return T_map_robot;
}

}  // namespace cairn::submap_graph
