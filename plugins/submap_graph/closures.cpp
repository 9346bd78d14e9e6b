#include "plugins/submap_graph/closures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::submap_graph {
namespace {

constexpr double kMaxTurnWhenSolved_rad = radians(5.0);
constexpr double kChi2_95 = 7.81;  // of three degrees of freedom

}  // namespace

void Closures::hold(std::span<const Pose2> T_map_node, double start_drift_m) {
  start_drift_m_ = start_drift_m;
  held_ = T_map_node.size();
  T_local_node_.assign(T_map_node.begin(), T_map_node.end());
  driven_m_.assign(held_, 0.0);
  points_m_.resize(held_);
}

void Closures::add_node(std::span<const Point> points_m, const Pose2& T_local_node) {
  const double step_m =
      T_local_node_.size() == held_ ? 0.0 : (T_local_node.position() - T_local_node_.back().position()).norm();
  driven_m_.push_back(driven_m_.empty() ? 0.0 : driven_m_.back() + step_m);
  T_local_node_.push_back(T_local_node);
  points_m_.emplace_back(points_m.begin(), points_m.end());
}

// Neighbours on the way are tied already.
bool Closures::is_neighbour(std::size_t node, const Submap& submap) const {
  return submap.anchor() >= held_ && driven_m_[node] >= driven_m_[submap.nodes().front()] - config_.submap_m &&
         driven_m_[node] <= driven_m_[submap.nodes().back()] + config_.submap_m;
}

std::vector<PassedSubmap> Closures::passed(std::size_t node, const TiedGraph& graph,
                                           std::span<const std::shared_ptr<const Submap>> finished) const {
  std::vector<PassedSubmap> passed;
  for (const std::shared_ptr<const Submap>& submap : finished) {
    if (is_neighbour(node, *submap)) continue;
    double distance_m = std::numeric_limits<double>::infinity();
    for (const std::size_t other : submap->nodes())
      distance_m = std::min(distance_m, (graph.T_map(other).position() - graph.T_map(node).position()).norm());
    passed.push_back({submap, graph.T_map(submap->anchor()), distance_m});
  }
  return passed;
}

LoopQuery Closures::query_of(std::size_t node, const TiedGraph& graph, std::span<const PassedSubmap> submaps) const {
  LoopQuery query;
  query.node = node;
  query.points_m = points_m_[node];
  query.gathered_m = config_.gather_m;
  query.echo_sigma_m = config_.echo_sigma_m;
  query.T_map_node = graph.T_map(node);
  query.submaps = submaps;
  return query;
}

std::vector<Closure> Closures::believed_of(const LoopQuery& query, const Budget& budget) {
  std::erase_if(waiting_, [&](const Waiting& waiting) {
    return driven_m_[query.node] - driven_m_[waiting.closure.node] > config_.witness_m;
  });
  std::vector<Closure> found;
  for (const LoopProposal& proposal : closer_->propose(query, budget))
    found.push_back({query.submaps[proposal.submap].submap->anchor(), query.node, proposal.T_submap_node,
                     proposal.information, proposal.score});
  return witnessed(found);
}

// The loop over both closures and the two pieces of the way between them comes back to where it began.
bool Closures::agree(const Closure& a, const Closure& b) const {
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

std::vector<Closure> Closures::witnessed(const std::vector<Closure>& found) {
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

std::vector<Closure> Closures::close(std::size_t node, const TiedGraph& graph,
                                     std::span<const std::shared_ptr<const Submap>> finished, const Budget& budget) {
  if (!closer_) return {};
  const std::vector<PassedSubmap> submaps = passed(node, graph, finished);
  LoopQuery query = query_of(node, graph, submaps);
  query.drift_m = start_drift_m_ + config_.drift_ratio * (driven_m_[node] - trusted_at_m_);
  std::vector<Closure> believed = believed_of(query, budget);
  if (believed.empty()) return believed;
  trusted_at_m_ = driven_m_[node];
  start_drift_m_ = 0.0;
  return believed;
}

std::vector<Closure> Closures::close_again(std::size_t node, const TiedGraph& graph,
                                           std::span<const std::shared_ptr<const Submap>> finished) {
  if (!closer_) return {};
  const std::vector<PassedSubmap> submaps = passed(node, graph, finished);
  LoopQuery query = query_of(node, graph, submaps);
  query.max_turn_rad = kMaxTurnWhenSolved_rad;
  query.is_afterwards = true;
  return believed_of(query, Budget{});
}

}  // namespace cairn::submap_graph
