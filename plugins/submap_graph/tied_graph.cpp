#include "plugins/submap_graph/tied_graph.hpp"

#include <algorithm>
#include <cmath>

#include "maps/pose_graph/information.hpp"

namespace cairn::submap_graph {
namespace {

constexpr double kChi2_99 = 11.34;  // of three degrees of freedom
constexpr double kChi2_999 = 16.27;
constexpr std::size_t kTiesInOneBroken = 100;  // one in so many may break
constexpr double kWorstPart = 0.25;
constexpr int kMaxRounds = 6;
constexpr int kMaxIterations = 30;
constexpr double kRelativeChange = 1e-6;
constexpr double kMapHeadingInformation = 1e8;  // 1/rad2: the axes of a map that is held do not turn

PoseEdge edge_of(const Closure& closure) {
  return {closure.anchor, closure.node, closure.T_anchor_node, closure.information};
}

}  // namespace

std::size_t TiedGraph::add_node(const Pose2& T_map_node) {
  graph_.T_map_node.push_back(T_map_node);
  return graph_.T_map_node.size() - 1;
}

void TiedGraph::tie(std::size_t anchor, std::size_t node, const Pose2& T_anchor_node,
                    const Eigen::Matrix3d& information, bool is_odometry) {
  graph_.edges.push_back(
      {anchor, node, T_anchor_node, information_in_turned(information, T_anchor_node.theta_rad), is_odometry});
}

void TiedGraph::expect_compass(double bias_rad, double local_bias_rad, double local_kept_ratio) {
  graph_.expected.compass_rad = bias_rad;
  graph_.expected.local_compass_rad = local_bias_rad;
  graph_.expected.local_kept_ratio = local_kept_ratio;
}

void TiedGraph::expect_odometry(double length_ratio, double turn_ratio) {
  graph_.expected.length_ratio = length_ratio;
  graph_.expected.turn_ratio = turn_ratio;
}

void TiedGraph::add(const Closure& closure) {
  closures_.push_back(closure);
  is_believed_.push_back(true);
}

std::size_t TiedGraph::believed() const {
  return static_cast<std::size_t>(std::count(is_believed_.begin(), is_believed_.end(), true));
}

bool TiedGraph::is_broken(const std::vector<bool>& believed, const PoseGraphSolution& solution) const {
  std::size_t broken = 0;
  for (const PoseEdge& edge : graph_.edges)
    if (chi2_of(edge, solution.T_map_node, solution.errors) > kChi2_999) ++broken;
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

PoseGraphSolution TiedGraph::solved_in_map(const PoseGraph& whole) const {
  const auto first = whole.T_map_node.begin() + static_cast<std::ptrdiff_t>(held_);
  PoseGraph in_map{{Pose2{}}, {}, {}, whole.expected, whole.errors};
  in_map.T_map_node.insert(in_map.T_map_node.end(), first, whole.T_map_node.end());
  in_map.edges.reserve(whole.edges.size());
  for (const PoseEdge& edge : whole.edges) in_map.edges.push_back(seen_from_map(edge));
  if (!whole.headings.empty()) in_map.headings.push_back({0, 0.0, kMapHeadingInformation});
  for (HeadingPrior heading : whole.headings) {
    heading.node -= held_ - 1;
    in_map.headings.push_back(heading);
  }
  PoseGraphSolution solution = cairn::solve(in_map, {kMaxIterations, kRelativeChange});
  // The solver may move all nodes together.
  const Pose2 T_map_solved = inverse(solution.T_map_node.front());
  std::vector<Pose2> T_map_node(whole.T_map_node.begin(), first);
  for (std::size_t i = 1; i < solution.T_map_node.size(); ++i)
    T_map_node.push_back(T_map_solved * solution.T_map_node[i]);
  solution.T_map_node = std::move(T_map_node);
  return solution;
}

PoseGraphSolution TiedGraph::solved_with(const std::vector<bool>& believed, std::vector<Pose2> T_map_node) const {
  PoseGraph whole{std::move(T_map_node), graph_.edges, graph_.headings, graph_.expected, graph_.errors};
  for (std::size_t i = 0; i < closures_.size(); ++i)
    if (believed[i]) whole.edges.push_back(edge_of(closures_[i]));
  return held_ > 0 ? solved_in_map(whole) : cairn::solve(whole, {kMaxIterations, kRelativeChange});
}

bool TiedGraph::solve() {
  std::vector<bool> believed = is_believed_;
  PoseGraphSolution solution = solved_with(believed, graph_.T_map_node);
  std::vector<double> chi2(closures_.size());
  for (int round = 0; round <= kMaxRounds; ++round) {
    double worst = 0.0;
    for (std::size_t i = 0; i < closures_.size(); ++i) {
      chi2[i] = chi2_of(edge_of(closures_[i]), solution.T_map_node);
      if (believed[i]) worst = std::max(worst, chi2[i]);
    }
    if (worst <= kChi2_99 || round == kMaxRounds) break;
    // The worst first: a false closure makes true ones look bad, which fit again without it.
    const double most = std::max(kChi2_99, kWorstPart * worst);
    for (std::size_t i = 0; i < closures_.size(); ++i)
      if (chi2[i] > most) believed[i] = false;
    solution = solved_with(believed, std::move(solution.T_map_node));
  }
  if (is_broken(believed, solution)) {
    closures_.resize(solved_);
    is_believed_.resize(solved_);
    return false;
  }
  for (std::size_t i = 0; i < closures_.size(); ++i) believed[i] = chi2[i] <= kChi2_99;
  solved_ = closures_.size();
  is_believed_ = std::move(believed);
  graph_.T_map_node = std::move(solution.T_map_node);
  graph_.errors = std::move(solution.errors);
  return true;
}

}  // namespace cairn::submap_graph
