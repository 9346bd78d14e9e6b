#include "plugins/submap_graph/local_map.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cairn::submap_graph {
namespace {

constexpr int kLocalLevels = 4;
constexpr double kMinScore = 0.3;
constexpr double kClearlyBetter = 0.03;

AlignmentSettings alignment_of(const Config& config) {
  AlignmentSettings settings;
  settings.echo_sigma_m = config.echo_sigma_m;
  return settings;
}

// Information over (x, y, theta) as it is in a frame turned by the angle.
Eigen::Matrix3d turned(const Eigen::Matrix3d& information, double angle_rad) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(angle_rad), -std::sin(angle_rad), std::sin(angle_rad), std::cos(angle_rad);
  return turn * information * turn.transpose();
}

}  // namespace

Eigen::Matrix3d LocalMap::step_information(const Pose2& T_submap_before, const Pose2& step) const {
  constexpr double kRest_m = 0.02;
  constexpr double kRest_rad = 0.01;
  const double length_m = step.position().norm();
  const double place_m = kRest_m + config_.odometry_ratio * length_m;
  const double turn_rad =
      kRest_rad + config_.odometry_rad_per_m * length_m + config_.odometry_rad_per_rad * std::abs(step.theta_rad);
  const Eigen::Vector3d deviations(place_m, place_m, turn_rad);
  const Eigen::Matrix3d information = deviations.cwiseProduct(deviations).cwiseInverse().asDiagonal();
  return turned(information, T_submap_before.theta_rad);
}

LocalPose LocalMap::match(std::span<const Point> points_m, const Pose2& T_odom_robot) {
  const Pose2 step = T_odom_robot_ ? inverse(*T_odom_robot_) * T_odom_robot : Pose2{};
  T_odom_robot_ = T_odom_robot;
  LocalPose local;
  local.information = step_information(T_older_robot_, step);
  local.T_submap_robot = T_older_robot_ * step;
  if (config_.gather_m <= 0.0 && !open_.empty() && !points_m.empty()) {
    const Alignment aligned = aligned_with_older(points_m, {local.T_submap_robot, local.information});
    local.T_submap_robot = aligned.T_map_scan;
    local.information += aligned.information;
    local.matched_ratio = aligned.matched_ratio;
  }
  T_older_robot_ = local.T_submap_robot;
  return local;
}

// From odometry, and from the best pose around it; odometry holds where both fit alike.
Alignment LocalMap::aligned_with_older(std::span<const Point> points_m, const PosePrediction& odometry) {
  const SurfaceMap& map = open_.front()->surfaces();
  const AlignmentSettings settings = alignment_of(config_);
  Alignment near = align(map, points_m, odometry.T_map_scan, odometry, settings);
  if (!field_) field_ = open_.front()->pyramid(kFieldCell_m, config_.search_sigma_m, kLocalLevels);
  const auto found = search(*field_, points_m, {odometry.T_map_scan, config_.search_m, config_.search_rad}, kMinScore);
  if (!found) return near;
  const Alignment other = align(map, points_m, found->T_field_scan, odometry, settings);
  return other.matched_ratio > near.matched_ratio + kClearlyBetter ? other : near;
}

void LocalMap::begin_submap(std::size_t node) {
  open_.push_back(std::make_shared<Submap>(node, config_.surface_cell_m));
  submaps_.push_back(open_.back());
  T_older_open_.push_back(open_.size() == 1 ? Pose2{} : T_older_robot_);
  driven_m_.push_back(0.0);
  if (open_.size() == 1) T_older_robot_ = Pose2{};
}

void LocalMap::add_node(std::size_t node, std::span<const Point> points_m, const LocalPose& local) {
  ties_.clear();
  if (T_older_node_) {
    const Pose2 step = inverse(*T_older_node_) * T_older_robot_;
    constexpr double kTurnAsDistance_m_per_rad = 1.0;
    for (double& driven_m : driven_m_)
      driven_m += step.position().norm() + kTurnAsDistance_m_per_rad * std::abs(step.theta_rad);
  }
  for (std::size_t i = 0; i < open_.size(); ++i)
    ties_.push_back({open_[i]->anchor(), inverse(T_older_open_[i]) * T_older_robot_,
                     turned(local.information, -T_older_open_[i].theta_rad)});
  if (open_.empty() || (open_.size() == 1 && driven_m_.front() >= 0.5 * config_.submap_m)) begin_submap(node);
  for (std::size_t i = 0; i < open_.size(); ++i)
    open_[i]->add(node, inverse(T_older_open_[i]) * T_older_robot_, points_m);
  T_older_node_ = T_older_robot_;
  field_.reset();
  if (open_.size() < 2 || driven_m_.front() < config_.submap_m) return;
  const Pose2 T_older_next = T_older_open_.back();
  T_older_robot_ = inverse(T_older_next) * T_older_robot_;
  T_older_node_ = T_older_robot_;
  open_.erase(open_.begin());
  driven_m_.erase(driven_m_.begin());
  T_older_open_.assign(1, Pose2{});
  ++older_;
}

}  // namespace cairn::submap_graph
