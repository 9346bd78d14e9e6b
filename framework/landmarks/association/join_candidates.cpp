#include "framework/landmarks/association/join_candidates.hpp"

#include <functional>
#include <map>
#include <queue>
#include <set>

#include "maps/landmarks/joined_landmarks.hpp"

namespace cairn {
namespace {

bool is_place(const Landmark& landmark) {
  return landmark.level == 0 && landmark.access.has_value();
}

std::vector<LandmarkId> ids_of_places(const LandmarkGraph& graph) {
  std::vector<LandmarkId> ids;
  for (const auto& [id, landmark] : graph.landmarks())
    if (is_place(landmark)) ids.push_back(id);
  return ids;
}

std::vector<Cell> cells_of_places(const LandmarkGraph& graph, const OccupancyGrid& grid) {
  std::vector<Cell> cells;
  for (const auto& [id, landmark] : graph.landmarks())
    if (is_place(landmark)) cells.push_back(grid.cell_at(landmark.access->position()));
  return cells;
}

using Neighbours = std::map<LandmarkId, std::vector<std::pair<LandmarkId, double>>>;  // with the length of the travel

std::vector<LandmarkId> nearest_of(LandmarkId from, std::size_t count, const Neighbours& neighbours) {
  using Waiting = std::pair<double, LandmarkId>;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> frontier;
  frontier.emplace(0.0, from);
  std::set<LandmarkId> settled;
  std::vector<LandmarkId> nearest;
  while (!frontier.empty() && nearest.size() < count) {
    const auto [here_m, here] = frontier.top();
    frontier.pop();
    if (!settled.insert(here).second) continue;
    if (here != from) nearest.push_back(here);
    const auto around = neighbours.find(here);
    if (around == neighbours.end()) continue;
    for (const auto& [there, length_m] : around->second)
      if (!settled.contains(there)) frontier.emplace(here_m + length_m, there);
  }
  return nearest;
}

}  // namespace

JoinCandidates::JoinCandidates(const LandmarkGraph& graph, const OccupancyGrid& grid, const DiscLattice& lattice)
    : ids_(ids_of_places(graph)), regions_(lattice, cells_of_places(graph, grid)) {
  for (const TravelRegions::Border& border : regions_.borders())
    by_length_.push_back({{ids_[border.first], ids_[border.second]}, border.length_m});
}

std::vector<RouteEnds> JoinCandidates::wanted(int nearest) const {
  std::set<RouteEnds> pairs;
  JoinedLandmarks joined;
  Neighbours neighbours;
  for (const auto& [pair, length_m] : by_length_) {
    if (joined.join(pair.first, pair.second)) pairs.insert(pair);
    neighbours[pair.first].emplace_back(pair.second, length_m);
    neighbours[pair.second].emplace_back(pair.first, length_m);
  }
  for (const LandmarkId id : ids_)
    for (const LandmarkId other : nearest_of(id, static_cast<std::size_t>(nearest), neighbours))
      pairs.insert(std::minmax(id, other));
  return {pairs.begin(), pairs.end()};
}

}  // namespace cairn
