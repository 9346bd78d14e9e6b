#include "framework/experiments/buildings/building.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "maps/geometry/segments.hpp"
#include "maps/grid/swept_disc.hpp"

namespace cairn {
namespace {

constexpr double kRadius_m = 0.22;

BuildingRules small(std::uint64_t seed) {
  return {100.0, 62, 0.1, kRadius_m, seed};
}

TEST(Building, RoutesAreFreeAndJoinAllLandmarks) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const SavedMap map = building(small(seed));
    EXPECT_EQ(map.graph.landmarks().size(), 62U);
    for (const auto& [id, route] : map.graph.routes()) {
      for (std::size_t i = 1; i < route.trajectory.size(); ++i)
        EXPECT_TRUE(
            sweep_is_free(map.grid, {}, route.trajectory[i - 1].position(), route.trajectory[i].position(), kRadius_m))
            << "route " << id;
      EXPECT_NEAR(route.cost_m, length_of(route.trajectory), 1e-9);
      EXPECT_NEAR((route.trajectory.back().position() - map.graph.find(route.to)->approach_pose().position()).norm(),
                  0.0, 1e-3);
    }
    std::set<LandmarkId> reached{map.graph.landmarks().begin()->first};
    std::vector<LandmarkId> open(reached.begin(), reached.end());
    while (!open.empty()) {
      const LandmarkId at = open.back();
      open.pop_back();
      for (const RouteId id : map.graph.routes_from(at))
        if (reached.insert(map.graph.find_route(id)->to).second) open.push_back(map.graph.find_route(id)->to);
    }
    EXPECT_EQ(reached.size(), map.graph.landmarks().size()) << "seed " << seed;
  }
}

TEST(Building, IsTheSameForTheSameSeedOnly) {
  EXPECT_TRUE(building(small(1)).grid == building(small(1)).grid);
  EXPECT_FALSE(building(small(1)).grid == building(small(2)).grid);
}

TEST(Building, PairsAreOfPlacesWhereTheRobotStands) {
  const SavedMap map = building(small(1));
  const auto pairs = random_pairs(map.grid, kRadius_m, 50, 4);
  EXPECT_EQ(pairs.size(), 50U);
  for (const auto& [from, to] : pairs)
    for (const Point& at : {from, to}) EXPECT_TRUE(sweep_is_free(map.grid, {}, at, at, kRadius_m));
  EXPECT_EQ(random_pairs(map.grid, kRadius_m, 50, 4), pairs);
}

}  // namespace
}  // namespace cairn
