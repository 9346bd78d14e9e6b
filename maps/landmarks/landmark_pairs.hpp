// Which landmarks of two graphs are the same thing, judged by category and place.
#pragma once

#include <vector>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

struct LandmarkPair {
  LandmarkId a = 0;
  LandmarkId b = 0;
  double distance_m = 0.0;
  bool operator==(const LandmarkPair&) const = default;
};

// Pairs of one category and one floor, no farther than within_m apart once b's landmarks are laid into a's frame: the
// nearest pair first, ties by the ids of a, then of b; no landmark stands in two. No category is a category too.
// O(n log n) where landmarks do not crowd.
[[nodiscard]] std::vector<LandmarkPair> near_pairs(const LandmarkGraph& a, const LandmarkGraph& b, const Pose2& T_a_b,
                                                   double within_m);

}  // namespace cairn
