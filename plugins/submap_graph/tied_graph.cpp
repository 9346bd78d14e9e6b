#include "plugins/submap_graph/tied_graph.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "maps/pose_graph/solver.hpp"

namespace cairn::submap_graph {
namespace {

constexpr double kChi2_99 = 11.34;  // of three degrees of freedom
constexpr double kChi2_999 = 16.27;
constexpr std::size_t kTiesInOneBroken = 100;  // one in so many may break
constexpr double kWorstPart = 0.25;
constexpr int kMaxRounds = 6;
constexpr int kMaxIterations = 30;
constexpr double kRelativeChange = 1e-6;

PoseEdge edge_of(const Closure& closure) {
  return {closure.anchor, closure.node, closure.T_anchor_node, closure.information};
}

}  // namespace

Eigen::Matrix3d with_floor(const Eigen::Matrix3d& information, double floor_m, double floor_rad) {
  const Eigen::Matrix3d covariance = (information + 1e-6 * Eigen::Matrix3d::Identity()).inverse();
  const Eigen::Vector3d floor(floor_m * floor_m, floor_m * floor_m, floor_rad * floor_rad);
  const Eigen::Matrix3d floored = covariance + Eigen::Matrix3d(floor.asDiagonal());
  const Eigen::Matrix3d result = floored.inverse();
  return 0.5 * (result + result.transpose());
}

Eigen::Matrix3d information_in_turned(const Eigen::Matrix3d& information, double angle_rad) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(angle_rad), -std::sin(angle_rad), std::sin(angle_rad), std::cos(angle_rad);
  return turn.transpose() * information * turn;
}

std::size_t TiedGraph::add_node(const Pose2& T_map_node) {
  graph_.T_map_node.push_back(T_map_node);
  return graph_.T_map_node.size() - 1;
}

void TiedGraph::tie(std::size_t anchor, std::size_t node, const Pose2& T_anchor_node,
                    const Eigen::Matrix3d& information) {
  graph_.edges.push_back({anchor, node, T_anchor_node, information_in_turned(information, T_anchor_node.theta_rad)});
}

void TiedGraph::add(const Closure& closure) {
  closures_.push_back(closure);
  is_believed_.push_back(true);
}

std::size_t TiedGraph::believed() const {
  return static_cast<std::size_t>(std::count(is_believed_.begin(), is_believed_.end(), true));
}

bool TiedGraph::is_broken(const std::vector<bool>& believed, const std::vector<Pose2>& T_map_node) const {
  std::size_t broken = 0;
  for (const PoseEdge& edge : graph_.edges)
    if (chi2_of(edge, T_map_node) > kChi2_999) ++broken;
  if (kTiesInOneBroken * broken > graph_.edges.size() + kTiesInOneBroken) return true;
  std::size_t pushed_out = 0;
  for (std::size_t i = 0; i < solved_; ++i)
    if (is_believed_[i] && !believed[i]) ++pushed_out;
  const auto newer = std::count(believed.begin() + static_cast<std::ptrdiff_t>(solved_), believed.end(), true);
  return pushed_out > static_cast<std::size_t>(newer);
}

PoseEdge TiedGraph::seen_from_map(PoseEdge edge) const {
  if (edge.from < held_) {
    edge.T_from_to = T_map(edge.from) * edge.T_from_to;
    edge.from = 0;
  } else {
    edge.from -= held_ - 1;
  }
  edge.to -= held_ - 1;
  return edge;
}

std::vector<Pose2> TiedGraph::solved_in_map(const std::vector<PoseEdge>& edges, std::vector<Pose2> T_map_node) const {
  const auto first = T_map_node.begin() + static_cast<std::ptrdiff_t>(held_);
  PoseGraph whole{{Pose2{}}, {}, {}};
  whole.T_map_node.insert(whole.T_map_node.end(), first, T_map_node.end());
  whole.edges.reserve(edges.size());
  for (const PoseEdge& edge : edges) whole.edges.push_back(seen_from_map(edge));
  const std::vector<Pose2> solved = cairn::solve(whole, {kMaxIterations, kRelativeChange}).T_map_node;
  // The solver may move all nodes together.
  std::transform(solved.begin() + 1, solved.end(), first,
                 [T_map_solved = inverse(solved.front())](const Pose2& pose) { return T_map_solved * pose; });
  return T_map_node;
}

std::vector<Pose2> TiedGraph::solved_with(const std::vector<bool>& believed, std::vector<Pose2> T_map_node) const {
  PoseGraph whole{std::move(T_map_node), graph_.edges, {}};
  for (std::size_t i = 0; i < closures_.size(); ++i)
    if (believed[i]) whole.edges.push_back(edge_of(closures_[i]));
  if (held_ > 0) return solved_in_map(whole.edges, std::move(whole.T_map_node));
  return cairn::solve(whole, {kMaxIterations, kRelativeChange}).T_map_node;
}

bool TiedGraph::solve() {
  std::vector<bool> believed = is_believed_;
  std::vector<Pose2> T_map_node = solved_with(believed, graph_.T_map_node);
  std::vector<double> chi2(closures_.size());
  for (int round = 0; round <= kMaxRounds; ++round) {
    double worst = 0.0;
    for (std::size_t i = 0; i < closures_.size(); ++i) {
      chi2[i] = chi2_of(edge_of(closures_[i]), T_map_node);
      if (believed[i]) worst = std::max(worst, chi2[i]);
    }
    if (worst <= kChi2_99 || round == kMaxRounds) break;
    // The worst first: a false closure makes true ones look bad, which fit again without it.
    const double most = std::max(kChi2_99, kWorstPart * worst);
    for (std::size_t i = 0; i < closures_.size(); ++i)
      if (chi2[i] > most) believed[i] = false;
    T_map_node = solved_with(believed, T_map_node);
  }
  if (is_broken(believed, T_map_node)) {
    closures_.resize(solved_);
    is_believed_.resize(solved_);
    return false;
  }
  for (std::size_t i = 0; i < closures_.size(); ++i) believed[i] = chi2[i] <= kChi2_99;
  solved_ = closures_.size();
  is_believed_ = std::move(believed);
  graph_.T_map_node = std::move(T_map_node);
  return true;
}

}  // namespace cairn::submap_graph
