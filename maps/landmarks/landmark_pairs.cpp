#include "maps/landmarks/landmark_pairs.hpp"

#include <algorithm>
#include <set>
#include <tuple>

namespace cairn {

std::vector<LandmarkPair> near_pairs(const LandmarkGraph& a, const LandmarkGraph& b, const Pose2& T_a_b,
                                     double within_m) {
  struct Placed {
    Point at_a;
    const Landmark* landmark;
  };
  std::vector<Placed> placed;
  for (const auto& [id, landmark] : b.landmarks())
    placed.push_back({T_a_b * landmark.T_map_landmark.position(), &landmark});
  std::ranges::stable_sort(placed, {}, [](const Placed& p) { return p.at_a.x(); });
  std::vector<LandmarkPair> candidates;
  for (const auto& [id, landmark] : a.landmarks()) {
    const Point at = landmark.T_map_landmark.position();
    auto next = std::ranges::lower_bound(placed, at.x() - within_m, {}, [](const Placed& p) { return p.at_a.x(); });
    for (; next != placed.end() && next->at_a.x() <= at.x() + within_m; ++next) {
      const double distance_m = (next->at_a - at).norm();
      if (distance_m <= within_m && next->landmark->category == landmark.category &&
          next->landmark->level == landmark.level)
        candidates.push_back({id, next->landmark->id, distance_m});
    }
  }
  std::ranges::sort(candidates, {}, [](const LandmarkPair& p) { return std::tuple(p.distance_m, p.a, p.b); });
  std::set<LandmarkId> taken_a;
  std::set<LandmarkId> taken_b;
  std::vector<LandmarkPair> pairs;
  for (const LandmarkPair& pair : candidates) {
    if (taken_a.contains(pair.a) || taken_b.contains(pair.b)) continue;
    taken_a.insert(pair.a);
    taken_b.insert(pair.b);
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace cairn
