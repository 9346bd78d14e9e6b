// LoopCloser: proposes which of the places that a robot has passed it passes again.
//
// It only proposes. Whether a proposal is believed is up to the localizer that asks (a second proposal that agrees, a
// robust solution, undoing as a whole), and so are poses, windows of the way and the graph.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "framework/contracts/module_context.hpp"
#include "maps/submaps/submap.hpp"

namespace cairn {

// A finished submap that the node may be in: neither one that the node is part of, nor a neighbour on the way.
struct PassedSubmap {
  std::shared_ptr<const Submap> submap;  // never null; the same object at each call, which does not change any more
  Pose2 T_map_submap;                    // as known now: it moves when the graph is solved
  double distance_m = 0.0;               // from the node to the nearest node of the submap, as known now
};

// A node of the pose graph whose place is searched for. Spans are valid during the call only.
struct LoopQuery {
  std::size_t node = 0;             // its number; they rise by the way
  std::span<const Point> points_m;  // finite, in the node's frame, of one scan or gathered; may be empty
  double gathered_m = 0.0;  // of sensors with few beams: the way over which odometry has put them together; 0: one scan
  double echo_sigma_m = 0.03;  // standard deviation of an echo
  Pose2 T_map_node;            // where the localizer believes it to be
  double drift_m = 0.0;        // what that may be off by, three standard deviations; a floor is the closer's own
  std::optional<double> max_turn_rad;  // and its heading, where the localizer knows a bound; else the closer's own
  // The way has come to its end and its graph is solved: there is time to look at more submaps, with smaller windows.
  bool is_afterwards = false;
  std::span<const PassedSubmap> submaps;  // in the order of the way; may be empty
};

// The node seen in a submap.
struct LoopProposal {
  std::size_t submap = 0;  // its place in LoopQuery::submaps
  Pose2 T_submap_node;
  // Inverse of the covariance of (x_m, y_m, theta_rad), axes as the node's: symmetric and positive definite. Where a
  // corridor says nothing of the place along it, this is small in that direction.
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  double score = 0.0;  // how well the echoes fit, from 0 to 1
};

class LoopCloser {
 public:
  virtual ~LoopCloser() = default;
  // At most one for each submap; none is an answer. The same calls give the same answers. Asked for each node in the
  // order of the way, also without submaps; at the end once more for each, is_afterwards. Mostly called in a thread
  // beside the mission's, never by two at once. Begins no submap once the budget is exhausted: nobody waits any more.
  // A proposal that is not finite, or cannot be, ends the mission with the module's name.
  [[nodiscard]] virtual std::vector<LoopProposal> propose(const LoopQuery& query, const Budget& budget) = 0;
};

template <>
struct PluginTraits<LoopCloser> {
  static constexpr PluginKind kKind = PluginKind::loop_closer;
  using Context = ModuleContext;
};

}  // namespace cairn
