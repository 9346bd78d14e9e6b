// Finds where a node's scan fits a submap that it is no part of, and believes it only with a second witness: another
// such closure near by, both by the way between them consistent (Mangelson and others, "Pairwise consistent measurement
// set maximization", ICRA 2018).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "maps/submaps/submap.hpp"
#include "plugins/submap_graph/config.hpp"
#include "plugins/submap_graph/tied_graph.hpp"

namespace cairn::submap_graph {

class Closer {
 public:
  explicit Closer(const Config& config) : config_(config) {}

  // Before all others: nodes whose places in the map are fixed, so that the way does not lead over them.
  void hold(std::span<const Pose2> T_map_node);
  // For each node, in order.
  void add_node(std::span<const Point> points_m, const Pose2& T_local_node);
  // Closures of the node that are to be believed now: its own, and waiting ones for which it is the second witness.
  [[nodiscard]] std::vector<Closure> close(std::size_t node, const TiedGraph& graph,
                                           std::span<const std::shared_ptr<const Submap>> finished);
  // The same with windows of the least size, for when the graph has been solved.
  [[nodiscard]] std::vector<Closure> close_again(std::size_t node, const TiedGraph& graph,
                                                 std::span<const std::shared_ptr<const Submap>> finished);

  // The way at which the pose was last tied to a place that was passed before.
  [[nodiscard]] double trusted_at_m() const { return trusted_at_m_; }

 private:
  struct Waiting {
    Closure closure;
    bool is_taken = false;
  };
  struct Candidate {
    const Submap* submap = nullptr;
    double distance_m = 0.0;
  };
  [[nodiscard]] std::vector<Candidate> candidates(std::size_t node, const TiedGraph& graph, double reach_m,
                                                  std::span<const std::shared_ptr<const Submap>> finished) const;
  [[nodiscard]] std::optional<Closure> match(std::size_t node, const Submap& submap, const TiedGraph& graph,
                                             double window_m, double window_rad);
  [[nodiscard]] std::vector<Closure> find(std::size_t node, const TiedGraph& graph, double window_m, double window_rad,
                                          std::size_t most, std::span<const std::shared_ptr<const Submap>> finished);
  [[nodiscard]] bool agree(const Closure& a, const Closure& b) const;
  [[nodiscard]] std::vector<Closure> witnessed(const std::vector<Closure>& found);
  const FieldPyramid& pyramid_of(const Submap& submap);

  Config config_;
  std::vector<std::vector<Point>> points_m_;  // of the nodes
  std::vector<Pose2> T_local_node_;           // the way, never corrected
  std::vector<double> driven_m_;
  std::size_t held_ = 0;  // so many nodes are fixed
  double trusted_at_m_ = 0.0;
  std::vector<Waiting> waiting_;
  std::vector<std::pair<const Submap*, std::unique_ptr<FieldPyramid>>> pyramids_;  // the latest used first
};

}  // namespace cairn::submap_graph
