// What knows the whole way: the pose graph, the search for closures, and solutions. It needs no scan to be waited for,
// so it may work in a thread of its own (LaserGraph), one part of the way after the other.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "maps/submaps/submap.hpp"
#include "plugins/submap_graph/closures.hpp"
#include "plugins/submap_graph/compass_headings.hpp"
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
  std::optional<double> compass_rad{};
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
  double start_drift_m = 0.0;     // how far off its beginning may be
};

class BackEnd {
 public:
  // closer: may be null.
  BackEnd(const Config& config, std::shared_ptr<LoopCloser> closer, const Compass& compass, const EarlierPart& earlier);

  Correction add(const Stretch& stretch);
  // Searches closures of a node again, with all submaps and small windows.
  void search_again(std::size_t node, std::span<const std::shared_ptr<const Submap>> submaps);
  // For the last time.
  Correction solve_last();
  // From another thread: nobody waits for what is under way any more.
  void cancel() { is_cancelled_ = true; }

  [[nodiscard]] const TiedGraph& graph() const { return graph_; }

 private:
  void add(const NewNode& node);
  void add_found(Closure closure);
  [[nodiscard]] bool has_new_evidence() const;
  [[nodiscard]] bool solve();
  [[nodiscard]] Correction correction(bool is_moved) const;

  Config config_;
  TiedGraph graph_;
  Closures closures_;
  std::atomic<bool> is_cancelled_ = false;
  CompassHeadings headings_;
  FinishedSubmaps finished_;
  std::size_t solved_at_node_ = 0;
  std::size_t solved_closures_ = 0;
};

}  // namespace cairn::submap_graph
