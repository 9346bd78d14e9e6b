#include "plugins/submap_graph/back_end.hpp"

namespace cairn::submap_graph {

BackEnd::BackEnd(const Config& config, const EarlierPart& earlier)
    : config_(config), closer_(config), finished_(earlier.submaps) {
  for (const Pose2& T_map_node : earlier.T_map_node) graph_.add_node(T_map_node);
  graph_.hold();
  closer_.hold(earlier.T_map_node);
}

Correction BackEnd::add(const Stretch& stretch) {
  for (const NewNode& node : stretch.nodes) add(node);
  for (const Closure& closure : stretch.closures) graph_.add(closure);
  // In a run that goes on the first closures count at once: until then it is where the start pose says.
  const bool is_first = graph_.held() > 0 && solved_closures_ == 0;
  const bool is_due = is_first || graph_.size() > solved_at_node_ + static_cast<std::size_t>(config_.solve_every_nodes);
  return correction(is_due && graph_.closures().size() > solved_closures_ && solve());
}

void BackEnd::add(const NewNode& node) {
  const std::size_t number = graph_.add_node(
      graph_.size() == graph_.held() ? node.T_last_node : graph_.T_map(graph_.size() - 1) * node.T_last_node);
  for (const LocalMap::Tie& tie : node.ties) graph_.tie(tie.anchor, number, tie.T_anchor_node, tie.information);
  finished_.insert(finished_.end(), node.finished.begin(), node.finished.end());
  closer_.add_node(node.points_m, node.T_local_node);
  for (const Closure& closure : closer_.close(number, graph_, finished_)) graph_.add(closure);
}

void BackEnd::search_again(std::size_t node, std::span<const std::shared_ptr<const Submap>> submaps) {
  for (const Closure& closure : closer_.close_again(node, graph_, submaps)) graph_.add(closure);
}

Correction BackEnd::solve_last() {
  return correction(!graph_.closures().empty() && solve());
}

bool BackEnd::solve() {
  solved_at_node_ = graph_.size() - 1;
  const bool is_moved = graph_.solve();
  solved_closures_ = graph_.closures().size();
  return is_moved;
}

Correction BackEnd::correction(bool is_moved) const {
  Correction correction;
  correction.trusted_at_m = closer_.trusted_at_m();
  if (!is_moved) return correction;
  correction.T_map_node.reserve(graph_.size());
  for (std::size_t node = 0; node < graph_.size(); ++node) correction.T_map_node.push_back(graph_.T_map(node));
  return correction;
}

}  // namespace cairn::submap_graph
