#include "plugins/behaviours/driving/lookout_route.hpp"

#include <algorithm>
#include <cmath>

#include "maps/grid/travel_field.hpp"

namespace cairn::behaviours {
namespace {

// What a metre costs, against one that is free.
constexpr double kNarrow = 4.0;    // too near to something
constexpr double kSeenOnce = 3.0;  // unknown, but an echo has come through
constexpr double kUnknown = 15.0;
constexpr double kOccupied = 20.0;
constexpr double kSurelyOccupied = 60.0;  // besides, at the map's bound of certainty
constexpr double kLookedAt = 12.0;        // less than a wall: a door is looked at twice before one
constexpr double kLookedAround_m = 0.8;

double price(Cell cell, const FreeSpace& space, const OccupancyGrid& grid, const std::vector<Point>& looked_at) {
  double price = 1.0;
  if (space.state(cell) == CellState::occupied) {
    const double certainty = static_cast<double>(grid.log_odds(cell)) / std::max(1, grid.clamp_quanta());
    price = kOccupied + kSurelyOccupied * std::clamp(certainty, 0.0, 1.0);
  } else if (space.state(cell) == CellState::unknown) {
    price = grid.log_odds(cell) < 0 ? kSeenOnce : kUnknown;
  } else if (space.distance_m(cell) < space.min_distance_m()) {
    price = kNarrow;
  }
  const Point at = space.centre_of(cell);
  for (const Point& seen : looked_at)
    if ((seen - at).norm() < kLookedAround_m) price += kLookedAt;
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

std::optional<LookoutRoute> lookout_route(const FreeSpace& space, const OccupancyGrid& grid, const Point& from,
                                          const Point& to, const std::vector<Point>& looked_at, double stand_off_m) {
  const CellBox box = space.box();
  if (box.empty() || !box.contains(space.cell_at(from))) return std::nullopt;
  const Cell beyond = space.cell_at(to);  // perhaps off the map: then the way there leads over its rim
  const Cell goal{std::clamp(beyond.x, box.min.x, box.max.x - 1), std::clamp(beyond.y, box.min.y, box.max.y - 1)};
  const std::size_t cells = static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height());
  const DistanceField everywhere(box, space.cell_m(), grid.origin_m(), std::vector<std::uint8_t>(cells, 1));
  const TravelField travel(everywhere, from, 0.0, [&](Cell c) { return price(c, space, grid, looked_at); });
  const std::vector<Cell> way = travel.path_to(goal);
  const auto occupied =
      std::find_if(way.begin(), way.end(), [&](Cell c) { return space.state(c) == CellState::occupied; });
  const auto closed =
      std::find_if(way.begin(), way.end(), [&](Cell c) { return !space.reaches(c) && c != way.front(); });
  const auto in_the_way = occupied != way.end() ? occupied : closed;
  if (in_the_way == way.end()) return std::nullopt;
  LookoutRoute look{space.centre_of(what_blocks(*in_the_way, space)), {from}};
  for (auto c = in_the_way; c != way.begin(); --c) {
    if (!space.reaches(*c) || (space.centre_of(*c) - look.at).norm() < stand_off_m) continue;
    look.path = space.path_to(*c);
    break;
  }
  return look;
}

}  // namespace cairn::behaviours
