// Asks the loop closer where a node's scan fits submaps that it is no part of, and believes it only with a second
// witness: another such closure near by, both by the way between them consistent (Mangelson and others, "Pairwise
// consistent measurement set maximization", ICRA 2018).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "framework/contracts/loop_closer.hpp"
#include "plugins/submap_graph/config.hpp"
#include "plugins/submap_graph/tied_graph.hpp"

namespace cairn::submap_graph {

class Closures {
 public:
  // closer: null: none are found.
  Closures(const Config& config, std::shared_ptr<LoopCloser> closer) : config_(config), closer_(std::move(closer)) {}

  // Before all others: nodes whose places in the map are fixed, so that the way does not lead over them. start_drift_m:
  // how far from where it is said to be the way may begin.
  void hold(std::span<const Pose2> T_map_node, double start_drift_m);
  // For each node, in order.
  void add_node(std::span<const Point> points_m, const Pose2& T_local_node);
  // Closures of the node that are to be believed now: its own, and waiting ones for which it is the second witness.
  [[nodiscard]] std::vector<Closure> close(std::size_t node, const TiedGraph& graph,
                                           std::span<const std::shared_ptr<const Submap>> finished,
                                           const Budget& budget);
  // The same when the graph has been solved.
  [[nodiscard]] std::vector<Closure> close_again(std::size_t node, const TiedGraph& graph,
                                                 std::span<const std::shared_ptr<const Submap>> finished);

  // The way at which the pose was last tied to a place that was passed before.
  [[nodiscard]] double trusted_at_m() const { return trusted_at_m_; }
  // How far from where it was said to be the way may have begun; 0 after the first closure.
  [[nodiscard]] double start_drift_m() const { return start_drift_m_; }

 private:
  struct Waiting {
    Closure closure;
    bool is_taken = false;
  };
  [[nodiscard]] bool is_neighbour(std::size_t node, const Submap& submap) const;
  [[nodiscard]] std::vector<PassedSubmap> passed(std::size_t node, const TiedGraph& graph,
                                                 std::span<const std::shared_ptr<const Submap>> finished) const;
  [[nodiscard]] LoopQuery query_of(std::size_t node, const TiedGraph& graph,
                                   std::span<const PassedSubmap> submaps) const;
  [[nodiscard]] std::vector<Closure> believed_of(const LoopQuery& query, const Budget& budget);
  [[nodiscard]] bool agree(const Closure& a, const Closure& b) const;
  [[nodiscard]] std::vector<Closure> witnessed(const std::vector<Closure>& found);

  Config config_;
  std::shared_ptr<LoopCloser> closer_;
  std::vector<std::vector<Point>> points_m_;  // of the nodes
  std::vector<Pose2> T_local_node_;           // the way, never corrected
  std::vector<double> driven_m_;
  std::size_t held_ = 0;  // so many nodes are fixed
  double trusted_at_m_ = 0.0;
  double start_drift_m_ = 0.0;
  std::vector<Waiting> waiting_;
};

}  // namespace cairn::submap_graph
