#include "plugins/behaviours/lookouts/lookout_route.hpp"

#include <algorithm>
#include <cmath>

#include "maps/grid/travel_field.hpp"

namespace cairn::behaviours {
namespace {

double price(Cell cell, const FreeSpace& space, const OccupancyGrid& grid, const std::vector<Point>& looked_at,
             const LookoutCosts& costs) {
  double price = 1.0;
  if (space.state(cell) == CellState::occupied) {
    const double certainty = static_cast<double>(grid.log_odds(cell)) / std::max(1, grid.clamp_quanta());
    price = costs.occupied + costs.certainly_occupied * std::clamp(certainty, 0.0, 1.0);
  } else if (space.state(cell) == CellState::unknown) {
    price = grid.log_odds(cell) < 0 ? costs.seen_once : costs.unknown;
  } else if (space.distance_m(cell) < space.min_distance_m()) {
    price = costs.narrow;
  }
  const Point at = space.centre_of(cell);
  for (const Point& seen : looked_at)
    if ((seen - at).norm() < costs.looked_at_radius_m) price += costs.looked_at;
  return price;
}

// The occupied cell that is nearest to one that cannot be crossed, as far as that is due to one; else the cell itself.
Cell what_blocks(Cell cell, const FreeSpace& space) {
  const int reach = static_cast<int>(std::ceil(space.min_distance_m() / space.cell_m()));
  Cell nearest = cell;
  int least2 = reach * reach + 1;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell c = cell + Cell{dx, dy};
      if (dx * dx + dy * dy >= least2 || space.state(c) != CellState::occupied) continue;
      least2 = dx * dx + dy * dy;
      nearest = c;
    }
  }
  return nearest;
}

}  // namespace

void LookoutCosts::describe(Fields<LookoutCosts>& fields) {
  using C = LookoutCosts;
  const Range cost{0.0, 1e5};
  fields.number("narrow", &C::narrow, cost, "", "cost of a metre too near to something; a free metre costs 1");
  fields.number("seen_once", &C::seen_once, cost, "", "of a metre that is unknown, but an echo has come through");
  fields.number("unknown", &C::unknown, cost, "", "of a metre that is unknown");
  fields.number("occupied", &C::occupied, cost, "", "of a metre that is occupied");
  fields.number("certainly_occupied", &C::certainly_occupied, cost, "",
                "added to that where the map is as certain as it can be");
  fields.number("looked_at", &C::looked_at, cost, "", "added near each place that was looked at");
  fields.number("looked_at_radius_m", &C::looked_at_radius_m, {0.0, 10.0}, "m", "this near");
}

std::optional<LookoutRoute> lookout_route(const FreeSpace& space, const OccupancyGrid& grid, const Point& from,
                                          const Point& to, const std::vector<Point>& looked_at, double stand_off_m,
                                          const LookoutCosts& costs) {
  const CellBox box = space.box();
  if (box.empty() || !box.contains(space.cell_at(from))) return std::nullopt;
  const Cell beyond = space.cell_at(to);  // perhaps off the map: then the path there leads over its edge
  const Cell goal{std::clamp(beyond.x, box.min.x, box.max.x - 1), std::clamp(beyond.y, box.min.y, box.max.y - 1)};
  const std::size_t cells = static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height());
  const DistanceField everywhere(box, space.cell_m(), grid.origin_m(), std::vector<std::uint8_t>(cells, 1));
  const TravelField travel(everywhere, from, 0.0, [&](Cell c) { return price(c, space, grid, looked_at, costs); });
  const std::vector<Cell> path = travel.path_to(goal);
  const auto occupied =
      std::find_if(path.begin(), path.end(), [&](Cell c) { return space.state(c) == CellState::occupied; });
  const auto closed =
      std::find_if(path.begin(), path.end(), [&](Cell c) { return !space.reaches(c) && c != path.front(); });
  const auto blocked = occupied != path.end() ? occupied : closed;
  if (blocked == path.end()) return std::nullopt;
  LookoutRoute look{space.centre_of(what_blocks(*blocked, space)), {from}};
  for (auto c = blocked; c != path.begin(); --c) {
    if (!space.reaches(*c) || (space.centre_of(*c) - look.at).norm() < stand_off_m) continue;
    look.path = space.path_to(*c);
    break;
  }
  return look;
}

}  // namespace cairn::behaviours
