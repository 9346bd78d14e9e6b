// Groups of things that stand near each other.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

struct ThingAt {
  Point at_m{0.0, 0.0};
  std::size_t sort = 0;  // only things of one sort make a group
};

// Things of one sort no farther than within_m (> 0) from each other, and what is near to one of these, and so
// on: indices by rising order, groups of two and more by their first. Where very many crowd within a few
// within_m, one group may come out as two. O(n log n).
[[nodiscard]] std::vector<std::vector<std::size_t>> near_groups(std::span<const ThingAt> things, double within_m);

}  // namespace cairn
