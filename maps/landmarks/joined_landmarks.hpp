// Sets of landmarks that are joined, directly or over others; at first each is alone.
#pragma once

#include <algorithm>
#include <map>
#include <utility>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

class JoinedLandmarks {
 public:
  // The lowest id of the set. Amortised O(log n), as are the others.
  [[nodiscard]] LandmarkId set_of(LandmarkId id) {
    LandmarkId root = id;
    for (auto above = above_.find(root); above != above_.end(); above = above_.find(root)) root = above->second;
    while (id != root) id = std::exchange(above_.at(id), root);
    return root;
  }
  [[nodiscard]] bool are_joined(LandmarkId a, LandmarkId b) { return set_of(a) == set_of(b); }
  // Whether they were in different sets.
  bool join(LandmarkId a, LandmarkId b) {
    const auto [low, high] = std::minmax({set_of(a), set_of(b)});
    if (low == high) return false;
    above_[high] = low;
    return true;
  }

 private:
  std::map<LandmarkId, LandmarkId> above_;  // a lower member; none: the lowest itself
};

// By the open routes of a graph, whichever their direction.
[[nodiscard]] inline JoinedLandmarks joined_by_routes(const LandmarkGraph& graph) {
  JoinedLandmarks joined;
  for (const auto& [id, route] : graph.routes())
    if (!route.closed) joined.join(route.from, route.to);
  return joined;
}

}  // namespace cairn
