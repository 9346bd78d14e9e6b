#include "maps/edit/difference.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "maps/grid/grid_overlay.hpp"

namespace cairn {
namespace {

constexpr double kUnmoved_m = 1e-5;

void compare_cells(const OccupancyGrid& a, const OccupancyGrid& b, MapDifference& difference) {
  // A grid without cells has no lattice worth keeping.
  const OccupancyGrid& lattice = a.bounds().empty() ? b : a;
  if (!a.bounds().empty() && !b.bounds().empty()) check_same_cell_size(a, b);
  const OccupancyThresholds thresholds;
  const auto compare = [&](Cell cell) {
    const LogOdds in_a = a.bounds().empty() ? LogOdds{0} : a.log_odds(cell);
    const LogOdds in_b = b.log_odds(cell_under(lattice, cell, b, {}));
    const CellState state_a = thresholds.state(in_a);
    const CellState state_b = thresholds.state(in_b);
    ++difference.cells[static_cast<std::size_t>(state_a)][static_cast<std::size_t>(state_b)];
    difference.other_probability += state_a == state_b && in_a != in_b;
  };
  // One grid after the other: between two that are far apart lie any number of cells that neither has.
  const auto compare_all_in = [&](const CellBox& box, const CellBox& but) {
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x)
        if (!but.contains({x, y})) compare({x, y});
  };
  compare_all_in(a.bounds(), {});
  compare_all_in(box_over(lattice, b, {}), a.bounds());
}

class LandmarkComparison {
 public:
  LandmarkComparison(const LandmarkGraph& a, const LandmarkGraph& b) : a_(a), b_(b) {}

  void compare(double near_m, MapDifference& difference) {
    for (const LandmarkPair& pair : near_pairs(a_, b_, {}, near_m)) take(pair.a, pair.b, difference);
    for (const auto& [id, landmark] : a_.landmarks())
      if (const Landmark* same_id = b_.find(id); same_id != nullptr && is_free(id, id) &&
                                                 same_id->category == landmark.category &&
                                                 same_id->level == landmark.level)
        take(id, id, difference);
    std::multimap<std::string, LandmarkId> by_name;
    for (const auto& [id, landmark] : b_.landmarks())
      if (!landmark.name.empty()) by_name.emplace(landmark.name, id);
    for (const auto& [id, landmark] : a_.landmarks())
      for (auto [next, end] = by_name.equal_range(landmark.name); next != end; ++next)
        if (is_free(id, next->second) && b_.find(next->second)->category == landmark.category)
          take(id, next->second, difference);
    for (const auto& [id, landmark] : a_.landmarks())
      if (!b_of_.contains(id)) difference.only_in_a.push_back(id);
    for (const auto& [id, landmark] : b_.landmarks())
      if (!taken_.contains(id)) difference.only_in_b.push_back(id);
    for (auto* pairs : {&difference.same, &difference.moved, &difference.renamed})
      std::ranges::sort(*pairs, {}, &LandmarkPair::a);
  }
  // What a landmark of a is called in b; 0: it is not there.
  [[nodiscard]] LandmarkId in_b(LandmarkId a) const {
    const auto found = b_of_.find(a);
    return found == b_of_.end() ? 0 : found->second;
  }

 private:
  [[nodiscard]] bool is_free(LandmarkId a, LandmarkId b) const { return !b_of_.contains(a) && !taken_.contains(b); }
  void take(LandmarkId a, LandmarkId b, MapDifference& difference) {
    b_of_[a] = b;
    taken_.insert(b);
    const Landmark& in_a = *a_.find(a);
    const Landmark& in_b = *b_.find(b);
    const LandmarkPair pair{a, b, (in_a.T_map_landmark.position() - in_b.T_map_landmark.position()).norm()};
    (pair.distance_m > kUnmoved_m ? difference.moved : difference.same).push_back(pair);
    if (in_a.name != in_b.name) difference.renamed.push_back(pair);
  }

  const LandmarkGraph& a_;
  const LandmarkGraph& b_;
  std::map<LandmarkId, LandmarkId> b_of_;
  std::set<LandmarkId> taken_;
};

void compare_routes(const LandmarkGraph& a, const LandmarkGraph& b, const LandmarkComparison& landmarks,
                    MapDifference& difference) {
  std::map<std::pair<LandmarkId, LandmarkId>, std::vector<const Route*>> between;  // in b
  for (const auto& [id, route] : b.routes()) between[{route.from, route.to}].push_back(&route);
  for (const auto& [id, route] : a.routes()) {
    const auto found = between.find({landmarks.in_b(route.from), landmarks.in_b(route.to)});
    if (found == between.end() || found->second.empty()) {
      difference.routes_only_in_a.push_back(id);
      continue;
    }
    const auto nearest = std::ranges::min_element(
        found->second, {}, [&, cost_m = route.cost_m](const Route* other) { return std::abs(other->cost_m - cost_m); });
    const Route& other = **nearest;
    found->second.erase(nearest);
    const bool is_same = other.closed == route.closed && std::abs(other.cost_m - route.cost_m) <= kUnmoved_m;
    (is_same ? difference.routes_same : difference.routes_changed).emplace_back(id, other.id);
  }
  for (const auto& [ends, routes] : between)
    for (const Route* route : routes) difference.routes_only_in_b.push_back(route->id);
  std::ranges::sort(difference.routes_only_in_b);
}

}  // namespace

std::int64_t MapDifference::cells_of_other_state() const {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (i != k) count += cells[i][k];
  return count;
}

bool MapDifference::is_same() const {
  return cells_of_other_state() == 0 && other_probability == 0 && moved.empty() && renamed.empty() &&
         only_in_a.empty() && only_in_b.empty() && routes_changed.empty() && routes_only_in_a.empty() &&
         routes_only_in_b.empty();
}

MapDifference difference_of(const SavedMap& a, const SavedMap& b, double near_m) {
  MapDifference difference;
  compare_cells(a.grid, b.grid, difference);
  LandmarkComparison landmarks(a.graph, b.graph);
  landmarks.compare(near_m, difference);
  compare_routes(a.graph, b.graph, landmarks, difference);
  return difference;
}

}  // namespace cairn
