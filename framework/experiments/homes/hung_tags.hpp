// Printed tags for random homes: on walls and furniture, where somebody could hang them.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/contracts/world.hpp"

namespace cairn {

// A straight face that a tag can hang on; its free side lies to the left of the way from a to b.
struct HomeFace {
  Point a_m{0.0, 0.0};
  Point b_m{0.0, 0.0};
};

// What nothing hangs behind: a piece of furniture's box.
struct HomeObstacle {
  Point min_m{0.0, 0.0};
  Point max_m{0.0, 0.0};
};

struct HungTagsConfig {
  int count = 0;
  double size_m = 0.16;
};

// Tags of the family 36h11 with numbers of their own, on faces by their length, 0.2 to 0.6 m above the floor, half a
// metre apart, with half a metre of room before the middle of each: furniture beside it may hide a part. Fewer where
// there is no place for more.
[[nodiscard]] std::vector<WorldTag> hung_tags(const HungTagsConfig& config, const std::vector<HomeFace>& faces,
                                              const std::vector<HomeObstacle>& obstacles, std::uint64_t seed);

}  // namespace cairn
