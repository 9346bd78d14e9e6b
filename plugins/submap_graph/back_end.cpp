#include "plugins/submap_graph/back_end.hpp"

#include <utility>

#include "maps/pose_graph/information.hpp"

namespace cairn::submap_graph {

BackEnd::BackEnd(const Config& config, std::shared_ptr<LoopCloser> closer, const Compass& compass,
                 const EarlierPart& earlier)
    : config_(config), closures_(config, std::move(closer)), headings_(compass), finished_(earlier.submaps) {
  if (config.gather_m > 0.0) graph_.expect_odometry(config.odometry_length_bias_ratio, config.odometry_turn_bias_ratio);
  for (const Pose2& T_map_node : earlier.T_map_node) graph_.add_node(T_map_node);
  graph_.hold();
  closures_.hold(earlier.T_map_node, start_drift_m(earlier));
}

Correction BackEnd::add(const Stretch& stretch) {
  for (const NewNode& node : stretch.nodes) add(node);
  for (const Closure& closure : stretch.closures) graph_.add(closure);
  // In a run that goes on the first closures count at once: until then it is where the start pose says.
  const bool is_first = graph_.held() > 0 && solved_closures_ == 0 && !graph_.closures().empty();
  const bool is_due = is_first || graph_.size() > solved_at_node_ + static_cast<std::size_t>(config_.solve_every_nodes);
  return correction(is_due && has_new_evidence() && solve());
}

// Of closures; where single scans say nothing of the heading, of the compass too.
bool BackEnd::has_new_evidence() const {
  return graph_.closures().size() > solved_closures_ || (config_.gather_m > 0.0 && graph_.has_headings());
}

void BackEnd::add(const NewNode& node) {
  const bool is_first = graph_.size() == graph_.held();
  const std::size_t number =
      graph_.add_node(is_first ? node.T_last_node : graph_.T_map(graph_.size() - 1) * node.T_last_node);
  for (const LocalMap::Tie& tie : node.ties) {
    const bool is_odometry = config_.gather_m > 0.0 && !is_first;
    graph_.tie(tie.anchor, number, tie.T_anchor_node, tie.information, is_odometry);
  }
  headings_.add(node.compass_rad, is_first ? 0.0 : node.T_last_node.position().norm(), graph_);
  finished_.insert(finished_.end(), node.finished.begin(), node.finished.end());
  closures_.add_node(node.points_m, node.T_local_node);
  const Budget budget{.cancel = &is_cancelled_};
  for (const Closure& closure : closures_.close(number, graph_, finished_, budget)) add_found(closure);
}

// Echoes of wide beams as points on their axes fit each other better than they are known.
void BackEnd::add_found(Closure closure) {
  constexpr double kGatheredFloor_m = 0.1;
  constexpr double kGatheredFloor_rad = radians(2.0);
  if (config_.gather_m > 0.0)
    closure.information = with_floor(closure.information, kGatheredFloor_m, kGatheredFloor_rad);
  graph_.add(closure);
}

void BackEnd::search_again(std::size_t node, std::span<const std::shared_ptr<const Submap>> submaps) {
  for (const Closure& closure : closures_.close_again(node, graph_, submaps)) add_found(closure);
}

Correction BackEnd::solve_last() {
  return correction((!graph_.closures().empty() || has_new_evidence()) && solve());
}

bool BackEnd::solve() {
  solved_at_node_ = graph_.size() - 1;
  const bool is_moved = graph_.solve();
  solved_closures_ = graph_.closures().size();
  return is_moved;
}

Correction BackEnd::correction(bool is_moved) const {
  Correction correction;
  correction.trusted_at_m = closures_.trusted_at_m();
  correction.start_drift_m = closures_.start_drift_m();
  if (!is_moved) return correction;
  correction.T_map_node.reserve(graph_.size());
  for (std::size_t node = 0; node < graph_.size(); ++node) correction.T_map_node.push_back(graph_.T_map(node));
  return correction;
}

}  // namespace cairn::submap_graph
