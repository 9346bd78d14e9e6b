#include "plugins/submap_graph/closures.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::submap_graph {
namespace {

constexpr int kClosureLevels = 6;
constexpr std::size_t kPyramidsKept = 24;
constexpr double kReach_m = 6.0;  // of a submap around its nodes, for candidates
constexpr std::size_t kCandidates = 4;
constexpr double kFloor_m = 0.03;
constexpr double kFloor_rad = radians(0.4);
constexpr double kChi2_95 = 7.81;  // of three degrees of freedom

}  // namespace

void Closer::hold(std::span<const Pose2> T_map_node) {
  held_ = T_map_node.size();
  T_local_node_.assign(T_map_node.begin(), T_map_node.end());
  driven_m_.assign(held_, 0.0);
  points_m_.resize(held_);
}

void Closer::add_node(std::span<const Point> points_m, const Pose2& T_local_node) {
  const double step_m =
      T_local_node_.size() == held_ ? 0.0 : (T_local_node.position() - T_local_node_.back().position()).norm();
  driven_m_.push_back(driven_m_.empty() ? 0.0 : driven_m_.back() + step_m);
  T_local_node_.push_back(T_local_node);
  points_m_.emplace_back(points_m.begin(), points_m.end());
}

const FieldPyramid& Closer::pyramid_of(const Submap& submap) {
  const auto at =
      std::find_if(pyramids_.begin(), pyramids_.end(), [&](const auto& kept) { return kept.first == &submap; });
  if (at != pyramids_.end()) {
    std::rotate(pyramids_.begin(), at, at + 1);
  } else {
    if (pyramids_.size() >= kPyramidsKept) pyramids_.pop_back();
    pyramids_.emplace(
        pyramids_.begin(), &submap,
        std::make_unique<FieldPyramid>(submap.pyramid(kFieldCell_m, config_.field_sigma_m, kClosureLevels)));
  }
  return *pyramids_.front().second;
}

std::vector<Closer::Candidate> Closer::candidates(std::size_t node, const TiedGraph& graph, double reach_m,
                                                  std::span<const std::shared_ptr<const Submap>> finished) const {
  std::vector<Candidate> found;
  for (const std::shared_ptr<const Submap>& submap : finished) {
    // Neighbours on the way are tied already.
    if (submap->anchor() >= held_ && driven_m_[node] >= driven_m_[submap->nodes().front()] - config_.submap_m &&
        driven_m_[node] <= driven_m_[submap->nodes().back()] + config_.submap_m)
      continue;
    double distance_m = std::numeric_limits<double>::infinity();
    for (const std::size_t other : submap->nodes())
      distance_m = std::min(distance_m, (graph.T_map(other).position() - graph.T_map(node).position()).norm());
    if (distance_m <= reach_m) found.push_back({submap.get(), distance_m});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance_m < b.distance_m; });
  return found;
}

std::optional<Closure> Closer::match(std::size_t node, const Submap& submap, const TiedGraph& graph, double window_m,
                                     double window_rad) {
  const std::vector<Point>& points_m = points_m_[node];
  const SearchWindow window{inverse(graph.T_map(submap.anchor())) * graph.T_map(node), window_m, window_rad};
  const auto coarse = search(pyramid_of(submap), points_m, window, config_.min_score);
  if (!coarse) return std::nullopt;
  AlignmentSettings settings;
  settings.echo_sigma_m = config_.echo_sigma_m;
  settings.first_sigma_m = 0.1;
  const Alignment aligned = align(submap.surfaces(), points_m, coarse->T_field_scan, {}, settings);
  if (aligned.matched_ratio < config_.min_matched_ratio) return std::nullopt;
  const Pose2 moved = inverse(coarse->T_field_scan) * aligned.T_map_scan;
  if (moved.position().norm() > 0.3 || std::abs(moved.theta_rad) > radians(3.0)) return std::nullopt;
  const Eigen::Matrix3d information = with_floor(aligned.information, kFloor_m, kFloor_rad);
  return Closure{submap.anchor(), node, aligned.T_map_scan,
                 information_in_turned(information, aligned.T_map_scan.theta_rad), coarse->score};
}

std::vector<Closure> Closer::find(std::size_t node, const TiedGraph& graph, double window_m, double window_rad,
                                  std::size_t most, std::span<const std::shared_ptr<const Submap>> finished) {
  std::vector<Closure> found;
  std::size_t tried = 0;
  for (const Candidate& candidate : candidates(node, graph, kReach_m + window_m, finished)) {
    if (++tried > most) break;
    if (const auto closure = match(node, *candidate.submap, graph, window_m, window_rad)) found.push_back(*closure);
  }
  return found;
}

// The loop over both closures and the two pieces of the way between them comes back to where it began.
bool Closer::agree(const Closure& a, const Closure& b) const {
  const double way_m = std::abs(driven_m_[a.node] - driven_m_[b.node]);
  const double other_way_m = std::abs(driven_m_[a.anchor] - driven_m_[b.anchor]);
  if (a.node == b.node && a.anchor == b.anchor) return false;
  if (way_m > config_.witness_m || other_way_m > config_.witness_m) return false;
  const Pose2 T_nodes = inverse(T_local_node_[a.node]) * T_local_node_[b.node];
  const Pose2 T_anchors = inverse(T_local_node_[a.anchor]) * T_local_node_[b.anchor];
  const Pose2 off = inverse(T_anchors * b.T_anchor_node) * (a.T_anchor_node * T_nodes);
  const double drift_m = config_.drift_ratio * (way_m + other_way_m);
  const double place_m = 0.1 + drift_m;
  const double turn_rad = radians(1.0) + radians(0.3) * (way_m + other_way_m);
  const double chi2 =
      off.position().squaredNorm() / (place_m * place_m) + off.theta_rad * off.theta_rad / (turn_rad * turn_rad);
  return chi2 <= kChi2_95;
}

std::vector<Closure> Closer::witnessed(const std::vector<Closure>& found) {
  std::vector<Closure> believed;
  for (const Closure& closure : found) {
    Waiting fresh{closure};
    for (Waiting& earlier : waiting_) {
      if (!agree(earlier.closure, closure)) continue;
      if (!earlier.is_taken) believed.push_back(earlier.closure);
      earlier.is_taken = true;
      fresh.is_taken = true;
    }
    if (fresh.is_taken) believed.push_back(closure);
    waiting_.push_back(fresh);
  }
  return believed;
}

std::vector<Closure> Closer::close(std::size_t node, const TiedGraph& graph,
                                   std::span<const std::shared_ptr<const Submap>> finished) {
  const double window_m =
      std::min(config_.min_window_m + config_.drift_ratio * (driven_m_[node] - trusted_at_m_), config_.max_window_m);
  std::erase_if(waiting_, [&](const Waiting& waiting) {
    return driven_m_[node] - driven_m_[waiting.closure.node] > config_.witness_m;
  });
  std::vector<Closure> believed = witnessed(find(node, graph, window_m, config_.window_rad, kCandidates, finished));
  if (!believed.empty()) trusted_at_m_ = driven_m_[node];
  return believed;
}

std::vector<Closure> Closer::close_again(std::size_t node, const TiedGraph& graph,
                                         std::span<const std::shared_ptr<const Submap>> finished) {
  std::erase_if(waiting_, [&](const Waiting& waiting) {
    return driven_m_[node] - driven_m_[waiting.closure.node] > config_.witness_m;
  });
  return witnessed(find(node, graph, 0.5 * config_.min_window_m, radians(5.0), 2 * kCandidates, finished));
}

}  // namespace cairn::submap_graph
