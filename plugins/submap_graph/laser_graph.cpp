#include "plugins/submap_graph/laser_graph.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "maps/pose_graph/information.hpp"

namespace cairn::submap_graph {
namespace {

constexpr double kTieFloor_m = 0.015;
constexpr double kTieFloor_rad = radians(0.25);
constexpr std::size_t kNodesInPart = 20;

Eigen::Matrix3d floored(const Eigen::Matrix3d& information) {
  return with_floor(information, kTieFloor_m, kTieFloor_rad);
}

}  // namespace

LaserGraph::LaserGraph(const Config& config, const Pose2& T_map_start, std::shared_ptr<LoopCloser> closer,
                       const Compass& compass, EarlierPart earlier)
    : config_(config),
      earlier_(std::move(earlier)),
      local_map_(config),
      gathered_(config.gather_m),
      T_map_node_(earlier_.T_map_node),
      start_drift_m_(start_drift_m(earlier_)),
      finished_nodes_(earlier_.T_map_node.size()),
      T_map_start_(T_map_start),
      back_end_(std::make_unique<BackEnd>(config, std::move(closer), compass, earlier_)) {}

LaserGraph::~LaserGraph() {
  if (back_end_) back_end_->cancel();
}

Pose2 LaserGraph::add(std::span<const Point> points_m, const Pose2& T_odom_robot, double stamp_s,
                      std::optional<double> compass_rad) {
  take_answer_when_due(stamp_s);
  compass_rad_ = compass_rad;
  const Pose2 T_map_robot = place(points_m, T_odom_robot);
  T_odom_robot_ = T_odom_robot;
  if (!search_ && !stretch_.nodes.empty()) begin_search(stamp_s);
  return T_map_robot;
}

Pose2 LaserGraph::pass(const Pose2& T_odom_robot, double stamp_s) {
  take_answer_when_due(stamp_s);
  const Scan last = scans_.back();
  scans_.push_back({last.node, last.T_node_scan * (inverse(T_odom_robot_) * T_odom_robot)});
  T_odom_robot_ = T_odom_robot;
  return T_map(scans_.back());
}

Pose2 LaserGraph::place(std::span<const Point> points_m, const Pose2& T_odom_robot) {
  const LocalPose local = local_map_.match(points_m, T_odom_robot);
  matched_ratio_ = local.matched_ratio;
  if (scans_.empty()) {
    T_map_node_.push_back(T_map_start_);
    gathered_.add(points_m, T_map_start_);
    take_node(T_map_start_, points_m, local);
    return T_map_start_;
  }
  covariance_ = covariance_in_map(local);
  const Pose2 T_node_robot = inverse(local_map_.T_older_node()) * local.T_submap_robot;
  gathered_.add(points_m, T_local_node_ * T_node_robot);
  if (T_node_robot.position().norm() < config_.node_m && std::abs(T_node_robot.theta_rad) < config_.node_rad) {
    scans_.push_back({nodes() - 1, T_node_robot});
    return T_map(scans_.back());
  }
  T_map_node_.push_back(T_map_node_.back() * T_node_robot);
  driven_m_ += T_node_robot.position().norm();
  take_node(T_node_robot, points_m, local);
  return T_map_node_.back();
}

void LaserGraph::see(const MarkerSighting& sighting) {
  const Scan& scan = scans_.back();
  if (const auto closure = marker_closures_.see(sighting, scan.node, scan.T_node_scan))
    stretch_.closures.push_back(*closure);
}

// The match's, the start's until the first closure, and the drift since the last one: a third of the window's growth,
// which is of three deviations.
Eigen::Matrix3d LaserGraph::covariance_in_map(const LocalPose& local) const {
  const double turn_rad = T_map_node_.back().theta_rad - local_map_.T_older_node().theta_rad;
  Eigen::Matrix3d covariance = information_in_turned(floored(local.information).inverse(), -turn_rad);
  const double drift_m = config_.drift_ratio / 3.0 * (driven_m_ - trusted_at_m_);
  const double start_m = start_drift_m_ / 3.0;
  covariance.diagonal().head<2>().array() += start_m * start_m + drift_m * drift_m;
  return 0.5 * (covariance + covariance.transpose());
}

void LaserGraph::take_node(const Pose2& step, std::span<const Point> points_m, const LocalPose& local) {
  T_local_node_ = T_local_node_ * step;
  scans_.push_back({nodes() - 1, Pose2{}});
  const bool gathers = config_.gather_m > 0.0;
  local_map_.add_node(nodes() - 1, gathers ? gathered_.since_last_node(T_local_node_) : points_m, local);
  const std::span<const Point> searched = gathers ? gathered_.all(T_local_node_) : points_m;
  const auto known = local_map_.submaps().begin();
  stretch_.nodes.push_back(
      {step,
       T_local_node_,
       {searched.begin(), searched.end()},
       ties(step),
       {known + static_cast<std::ptrdiff_t>(finished_), known + static_cast<std::ptrdiff_t>(local_map_.finished())},
       compass_rad_});
  finished_ = local_map_.finished();
}

FinishedSubmaps LaserGraph::all_submaps() const {
  FinishedSubmaps all = earlier_.submaps;
  all.insert(all.end(), local_map_.submaps().begin(), local_map_.submaps().end());
  return all;
}

std::vector<LocalMap::Tie> LaserGraph::ties(const Pose2& step) const {
  std::vector<LocalMap::Tie> ties;
  const std::size_t first = earlier_.T_map_node.size();
  if (first > 0 && nodes() == first + 1) {
    ties.push_back(start_tie(earlier_, T_map_start_));
  } else if (config_.gather_m <= 0.0) {
    ties = local_map_.ties();
    for (LocalMap::Tie& tie : ties) tie.information = floored(tie.information);
  } else if (nodes() > 1) {
    ties.push_back({nodes() - 2, step, floored(local_map_.step_information(Pose2{}, step))});
  }
  return ties;
}

void LaserGraph::take_answer_when_due(double stamp_s) {
  if (!search_) return;
  const double since_s = stamp_s - search_->begun_s;
  const bool is_early = since_s >= 0.0 && since_s < kAnswerAfter_s && ++search_->scans < kAnswerAfterScans;
  if (!is_early) finish_search();
}

void LaserGraph::finish_search() {
  if (!search_) return;
  std::future<Correction> answer = std::move(search_->answer);
  search_.reset();
  try {
    take(answer.get());
  } catch (...) {
    is_finished_ = true;  // the back end lacks nodes for good
    throw;
  }
}

// Nodes that came meanwhile keep their place beside the last one that was solved.
void LaserGraph::take(const Correction& correction) {
  trusted_at_m_ = correction.trusted_at_m;
  start_drift_m_ = correction.start_drift_m;
  const std::vector<Pose2>& solved = correction.T_map_node;
  if (solved.empty()) return;
  const Pose2 moved = solved.back() * inverse(T_map_node_[solved.size() - 1]);
  std::copy(solved.begin(), solved.end(), T_map_node_.begin());
  for (std::size_t node = solved.size(); node < nodes(); ++node) T_map_node_[node] = moved * T_map_node_[node];
  ++revision_;
}

void LaserGraph::begin_search(double stamp_s) {
  const auto search = [back_end = back_end_.get(), stretch = std::exchange(stretch_, {})] {
    return back_end->add(stretch);
  };
  search_.emplace(Search{std::async(std::launch::async, search), stamp_s, 0});
}

const TiedGraph& LaserGraph::graph() const {
  if (search_) search_->answer.wait();
  return back_end_->graph();
}

bool LaserGraph::finish_part() {
  if (is_finished_) return false;
  finish_search();
  if (!stretch_.nodes.empty() || !stretch_.closures.empty()) take(back_end_->add(std::exchange(stretch_, {})));
  const std::size_t end = std::min(finished_nodes_ + kNodesInPart, nodes());
  const FinishedSubmaps submaps = all_submaps();
  for (; finished_nodes_ < end; ++finished_nodes_) back_end_->search_again(finished_nodes_, submaps);
  if (finished_nodes_ < nodes()) return true;
  take(back_end_->solve_last());
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
