#include "plugins/behaviours/driving/openings.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include "plugins/behaviours/driving/path_follower.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kRoomBehind_m2 = 1.0;
constexpr double kRoomOutOfReach_m2 = 0.5;
constexpr double kRoomForWay = 4.0;
constexpr double kRoomy_m = 0.8;
constexpr double kRoomToDrive_m2 = 0.2;  // what is seen of a room through its door
constexpr double kSameOpening_m = 0.5;

// Free cells with room for the robot that it does not get to, in connected groups.
std::vector<CellGroup> places_behind(const FreeSpace& space, double min_m2,
                                     const std::function<bool(Cell)>& is_wanted) {
  std::vector<Cell> behind;
  const CellBox box = space.box();
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const Cell c{x, y};
      const bool is_roomy = space.state(c) == CellState::free && space.distance_m(c) >= space.min_distance_m();
      if (is_roomy && !space.reaches(c) && is_wanted(c)) behind.push_back(c);
    }
  }
  std::vector<CellGroup> groups = grouped(behind, 1);
  const double cell_m2 = space.cell_m() * space.cell_m();
  std::erase_if(groups, [&](const CellGroup& g) { return static_cast<double>(g.size()) * cell_m2 < min_m2; });
  return groups;
}

std::vector<CellGroup> places_behind(const FreeSpace& space, const FreeSpace& squeezed, double min_m2) {
  return places_behind(space, min_m2, [&](Cell c) { return squeezed.reaches(c); });
}

// Where the slimmer robot's way to a place leaves what the robot itself can reach.
std::optional<Opening> opening_on_way(const FreeSpace& space, const std::vector<Point>& way) {
  std::optional<Opening> opening;
  const double length_m = length_of(way);
  for (double s = 0.0; s <= length_m; s += 0.5 * space.cell_m()) {
    const Point p = point_along(way, s);
    const Cell cell = space.cell_at(p);
    if (space.reaches(cell)) {
      opening = Opening{p, cell};
    } else if (opening) {
      opening->at_m = p;
      return opening;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Opening> nearest_opening(const FreeSpace& space, const FreeSpace& squeezed,
                                       const std::vector<Point>& seen) {
  std::optional<Opening> best;
  double best_m = std::numeric_limits<double>::infinity();
  for (const CellGroup& place : places_behind(space, squeezed, kRoomBehind_m2)) {
    const Cell nearest = *std::min_element(place.begin(), place.end(),
                                           [&](Cell a, Cell b) { return squeezed.cost_m(a) < squeezed.cost_m(b); });
    const std::optional<Opening> opening = opening_on_way(space, squeezed.path_to(nearest));
    if (!opening || space.cost_m(opening->lookout) >= best_m) continue;
    const bool is_seen = std::any_of(seen.begin(), seen.end(),
                                     [&](const Point& p) { return (p - opening->at_m).norm() < kSameOpening_m; });
    if (is_seen) continue;
    best = opening;
    best_m = space.cost_m(opening->lookout);
  }
  return best;
}

bool tighter_leads_on(const FreeSpace& space, const FreeSpace& tighter) {
  return !places_behind(space, tighter, kRoomToDrive_m2).empty();
}

std::optional<Point> room_out_of_reach(const FreeSpace& space, const Point& from, const std::vector<Point>& done) {
  const auto is_done = [&](const CellGroup& room) {
    return std::ranges::any_of(room, [&](Cell c) {
      return std::ranges::any_of(done,
                                 [&](const Point& p) { return (p - space.centre_of(c)).norm() < kSameOpening_m; });
    });
  };
  std::vector<CellGroup> rooms = places_behind(space, kRoomOutOfReach_m2, [](Cell) { return true; });
  std::erase_if(rooms, is_done);
  const auto largest =
      std::ranges::max_element(rooms, [](const CellGroup& a, const CellGroup& b) { return a.size() < b.size(); });
  if (largest == rooms.end()) return std::nullopt;
  // Well inside, so that from there the room is nearer than what it comes from.
  const auto worth_m = [&](Cell c) {
    return kRoomForWay * std::min(space.distance_m(c), kRoomy_m) - (space.centre_of(c) - from).norm();
  };
  return space.centre_of(*std::ranges::max_element(*largest, [&](Cell a, Cell b) { return worth_m(a) < worth_m(b); }));
}

}  // namespace cairn::behaviours
