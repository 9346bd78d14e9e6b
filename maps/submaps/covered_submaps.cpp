#include "maps/submaps/covered_submaps.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace cairn {
namespace {

constexpr double kPlace_m = 0.1;

using Place = std::int64_t;

Place place_at(std::int64_t x, std::int64_t y) {
  return x * (std::int64_t{1} << 32) + y;
}

// Each once.
void make_unique(std::vector<Place>& places) {
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
}

// Where a submap has echoes; reach 1: and beside them.
std::vector<Place> places_of(const KeptSubmap& submap, const Pose2& T_map_anchor, int reach) {
  std::vector<Place> places;
  for (const Point& point_m : echoes_of(submap, 1)) {
    const Point at_m = T_map_anchor * point_m;
    const auto x = static_cast<std::int64_t>(std::floor(at_m.x() / kPlace_m));
    const auto y = static_cast<std::int64_t>(std::floor(at_m.y() / kPlace_m));
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) places.push_back(place_at(x + dx, y + dy));
  }
  make_unique(places);
  return places;
}

const Pose2& anchor_of(const KeptSubmaps& submaps, const KeptSubmap& submap) {
  return std::ranges::lower_bound(submaps.nodes, submap.anchor, {}, &KeptNode::number)->T_map_node;
}

// How many submaps have seen each place.
class Cover {
 public:
  void add(const std::vector<Place>& places) {
    for (const Place place : places) ++submaps_[place];
  }
  [[nodiscard]] double covered_ratio(const std::vector<Place>& places, int submaps) const {
    const auto covered = std::ranges::count_if(places, [&](Place place) {
      const auto found = submaps_.find(place);
      return found != submaps_.end() && found->second >= submaps;
    });
    return places.empty() ? 0.0 : static_cast<double>(covered) / static_cast<double>(places.size());
  }

 private:
  std::unordered_map<Place, int> submaps_;
};

std::vector<KeptSubmap> uncovered(KeptSubmaps& submaps, const CoverRules& rules) {
  Cover cover;
  std::vector<KeptSubmap> left;
  left.reserve(submaps.submaps.size());
  for (auto submap = submaps.submaps.rbegin(); submap != submaps.submaps.rend(); ++submap) {
    const Pose2& T_map_anchor = anchor_of(submaps, *submap);
    if (cover.covered_ratio(places_of(*submap, T_map_anchor, 0), rules.newer) >= rules.covered_ratio) continue;
    cover.add(places_of(*submap, T_map_anchor, 1));
    left.push_back(std::move(*submap));
  }
  std::ranges::reverse(left);
  return left;
}

}  // namespace

void drop_covered(KeptSubmaps& submaps, double submap_m, const CoverRules& rules) {
  const std::size_t before = submaps.submaps.size();
  submaps.submaps = uncovered(submaps, rules);
  if (submaps.submaps.size() == before) return;
  std::vector<std::int64_t> used;
  for (const KeptSubmap& submap : submaps.submaps)
    for (const KeptNode& node : nodes_of(submaps, submap, submap_m)) used.push_back(node.number);
  make_unique(used);
  const auto is_unused = [&](std::int64_t number) { return !std::ranges::binary_search(used, number); };
  std::erase_if(submaps.nodes, [&](const KeptNode& node) { return is_unused(node.number); });
  std::erase_if(submaps.edges, [&](const KeptEdge& edge) { return is_unused(edge.from) || is_unused(edge.to); });
}

}  // namespace cairn
