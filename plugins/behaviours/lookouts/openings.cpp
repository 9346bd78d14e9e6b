#include "plugins/behaviours/lookouts/openings.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include "plugins/common/motion/path.hpp"

namespace cairn::behaviours {
namespace {

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

std::vector<CellGroup> places_behind(const FreeSpace& space, const FreeSpace& narrow, double min_m2) {
  return places_behind(space, min_m2, [&](Cell c) { return narrow.reaches(c); });
}

// Where the slimmer robot's path to a place leaves what the robot itself can reach.
std::optional<Opening> opening_on_path(const FreeSpace& space, const std::vector<Point>& path) {
  std::optional<Opening> opening;
  const double length_m = length_of(path);
  for (double s = 0.0; s <= length_m; s += 0.5 * space.cell_m()) {
    const Point p = motion::point_along(path, s);
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

void OpeningSettings::describe(Fields<OpeningSettings>& fields) {
  using C = OpeningSettings;
  fields.number("room_behind_m2", &C::room_behind_m2, {0.0, 1e4}, "m2",
                "an opening is looked into when so much room lies behind it");
  fields.number("room_out_of_reach_m2", &C::room_out_of_reach_m2, {0.0, 1e4}, "m2",
                "a place out of reach is a room from this size on");
  fields.number("room_to_drive_m2", &C::room_to_drive_m2, {0.0, 1e4}, "m2",
                "the robot keeps less room beside it when that leads to so much more; what is seen through a door");
  fields.number("clearance_weight", &C::clearance_weight, {0.0, 1000.0}, "",
                "metres of path that a metre of room is worth");
  fields.number("roomy_m", &C::roomy_m, {0.0, 50.0}, "m", "more room than this is no better");
  fields.number("same_m", &C::same_m, {0.0, 50.0}, "m", "openings and places this near to each other are the same");
}

std::optional<Opening> nearest_opening(const FreeSpace& space, const FreeSpace& narrow, const std::vector<Point>& seen,
                                       const OpeningSettings& settings) {
  std::optional<Opening> best;
  double best_m = std::numeric_limits<double>::infinity();
  for (const CellGroup& place : places_behind(space, narrow, settings.room_behind_m2)) {
    const Cell nearest = *std::min_element(place.begin(), place.end(),
                                           [&](Cell a, Cell b) { return narrow.cost_m(a) < narrow.cost_m(b); });
    const std::optional<Opening> opening = opening_on_path(space, narrow.path_to(nearest));
    if (!opening || space.cost_m(opening->lookout) >= best_m) continue;
    const bool is_seen = std::any_of(seen.begin(), seen.end(),
                                     [&](const Point& p) { return (p - opening->at_m).norm() < settings.same_m; });
    if (is_seen) continue;
    best = opening;
    best_m = space.cost_m(opening->lookout);
  }
  return best;
}

bool tighter_leads_on(const FreeSpace& space, const FreeSpace& tighter, const OpeningSettings& settings) {
  return !places_behind(space, tighter, settings.room_to_drive_m2).empty();
}

std::optional<Point> room_out_of_reach(const FreeSpace& space, const Point& from, const std::vector<Point>& done,
                                       const OpeningSettings& settings) {
  const auto is_done = [&](const CellGroup& room) {
    return std::ranges::any_of(room, [&](Cell c) {
      return std::ranges::any_of(done,
                                 [&](const Point& p) { return (p - space.centre_of(c)).norm() < settings.same_m; });
    });
  };
  std::vector<CellGroup> rooms = places_behind(space, settings.room_out_of_reach_m2, [](Cell) { return true; });
  std::erase_if(rooms, is_done);
  const auto largest =
      std::ranges::max_element(rooms, [](const CellGroup& a, const CellGroup& b) { return a.size() < b.size(); });
  if (largest == rooms.end()) return std::nullopt;
  // Well inside, so that from there the room is nearer than what it comes from.
  const auto worth_m = [&](Cell c) {
    return settings.clearance_weight * std::min(space.distance_m(c), settings.roomy_m) -
           (space.centre_of(c) - from).norm();
  };
  return space.centre_of(*std::ranges::max_element(*largest, [&](Cell a, Cell b) { return worth_m(a) < worth_m(b); }));
}

}  // namespace cairn::behaviours
