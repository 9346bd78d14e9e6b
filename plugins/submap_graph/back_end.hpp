// What knows the whole way: the pose graph, the search for closures, and solutions. It needs no scan to be waited for,
// so it may work in a thread of its own (LaserGraph), one part of the way after the other.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "maps/submaps/submap.hpp"
#include "plugins/submap_graph/closures.hpp"
#include "plugins/submap_graph/config.hpp"
#include "plugins/submap_graph/earlier_part.hpp"
#include "plugins/submap_graph/local_map.hpp"
#include "plugins/submap_graph/tied_graph.hpp"

namespace cairn::submap_graph {

// A node as the local map leaves it.
struct NewNode {
  Pose2 T_last_node;  // from the node before; of the first of the run: in the map
  Pose2 T_local_node;
  std::vector<Point> points_m;  // that closures are searched with
  std::vector<LocalMap::Tie> ties;
  FinishedSubmaps finished;  // with this node
};

// A piece of the way.
struct Stretch {
  std::vector<NewNode> nodes;
  std::vector<Closure> closures;  // found otherwise, with nodes known by then
};

// What has come of it.
struct Correction {
  std::vector<Pose2> T_map_node;  // of all nodes so far; none: nothing has moved
  double trusted_at_m = 0.0;      // the way at which the pose was last tied to a place passed before
};

class BackEnd {
 public:
  BackEnd(const Config& config, const EarlierPart& earlier);

  Correction add(const Stretch& stretch);
  // Searches closures of a node again, with all submaps and small windows.
  void search_again(std::size_t node, std::span<const std::shared_ptr<const Submap>> submaps);
  // For the last time.
  Correction solve_last();

  [[nodiscard]] const TiedGraph& graph() const { return graph_; }

 private:
  void add(const NewNode& node);
  [[nodiscard]] bool solve();
  [[nodiscard]] Correction correction(bool is_moved) const;

  Config config_;
  TiedGraph graph_;
  Closer closer_;
  FinishedSubmaps finished_;
  std::size_t solved_at_node_ = 0;
  std::size_t solved_closures_ = 0;
};

}  // namespace cairn::submap_graph
