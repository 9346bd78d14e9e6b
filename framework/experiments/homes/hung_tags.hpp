// Printed tags for random homes: on walls and furniture, where somebody could hang them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/experiments/homes/home.hpp"

namespace cairn {

// A straight face that a tag can hang on; its free side lies to the left of the way from a to b.
struct HomeFace {
  Point a_m{0.0, 0.0};
  Point b_m{0.0, 0.0};
};

struct HomeFurniture {
  HomeRoom box;
  bool is_round = false;  // nothing hangs on it
};

struct HungTagsConfig {
  int count = 0;
  double size_m = 0.16;
};

struct HomeToTag {
  const std::vector<HomeRoom>& rooms;
  std::vector<HomeFace> walls;
  std::vector<HomeFurniture> furniture;
};

// The list `tags` of a world file: of the family 36h11 with numbers of their own, on faces by their length, 0.2 to 0.6
// m above the floor, half a metre apart, with half a metre of room before the middle of each: furniture beside it may
// hide a part. Fewer where there is no place for more.
[[nodiscard]] std::string hung_tags_yaml(const HungTagsConfig& config, const HomeToTag& home, std::uint64_t seed);

}  // namespace cairn
