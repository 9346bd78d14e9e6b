#include "planners/common/disc_space/places.hpp"

#include <fmt/format.h>

namespace cairn {
namespace {

constexpr double kTie_m = 1e-9;

GroundRules only_occupied(GroundRules rules) {
  rules.unknown = UnknownPolicy::allow;
  return rules;
}

// Distance from a point to the nearest square of a state, or infinity beyond reach_m.
double distance_to_state_m(const OccupancyGrid& grid, const GroundRules& rules, const Point& p_map, double reach_m,
                           CellState state) {
  const Cell at = grid.cell_at(p_map);
  // All beyond one cell outside the map is as unknown as that cell.
  const CellBox map = grid.bounds().grown(1);
  const double most = 2.0 * (map.width() + map.height());
  const int reach = static_cast<int>(std::min(std::ceil(reach_m / grid.cell_m()), most)) + 1;
  const CellBox box = intersected(map, CellBox{at, {at.x + 1, at.y + 1}}.grown(reach));
  double best_m = std::numeric_limits<double>::infinity();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (grid.state({x, y}, rules.thresholds) == state)
        best_m = std::min(best_m, distance_to_square_m(p_map, p_map, grid.centre_of({x, y}), grid.cell_m()));
  return best_m <= reach_m ? best_m : std::numeric_limits<double>::infinity();
}

}  // namespace

std::string metres_text(double value_m) {
  return fmt::format("{:.2f} m", value_m);
}

std::string text_of(const Point& p_map) {
  return fmt::format("({:.2f}, {:.2f})", p_map.x(), p_map.y());
}

std::optional<Point> nearest_fit(const DiscSpace& space, const Point& near_map, double radius_m, double within_m,
                                 const std::function<bool(const Point&)>& accept) {
  if (!near_map.allFinite()) return std::nullopt;
  const DistanceField& field = space.field();
  const Cell at = field.cell_at(near_map);
  const int reach = static_cast<int>(std::ceil(within_m / space.cell_m()));
  const CellBox box = intersected(field.box(), CellBox{at, {at.x + 1, at.y + 1}}.grown(reach));
  std::optional<Point> best;
  double best_m = within_m;
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const Point centre = field.centre_of({x, y});
      const double away_m = (centre - near_map).norm();
      if (away_m > (best ? best_m - kTie_m : best_m)) continue;
      if (!space.fits(centre, radius_m) || (accept && !accept(centre))) continue;
      best = centre;
      best_m = away_m;
    }
  }
  return best;
}

std::optional<Pose2> approach_pose(const DiscSpace& space, const Landmark& landmark, double radius_m,
                                   const std::function<bool(const Point&)>& accept) {
  const Point centre = landmark.T_map_landmark.position();
  const Point wanted = landmark.access ? landmark.access->position() : centre;
  if (landmark.access && space.fits(wanted, radius_m) && (!accept || accept(wanted))) return landmark.access;
  const std::optional<Point> near = nearest_fit(space, wanted, radius_m, kApproachNear_m, accept);
  if (!near) return std::nullopt;
  const Point look = centre - *near;
  return Pose2{near->x(), near->y(), std::atan2(look.y(), look.x())};
}

std::string why_blocked(const OccupancyGrid& grid, const DiscSpace& space, const Point& p_map, double radius_m) {
  if (!space.contains(p_map)) return "it lies outside the map";
  const GroundRules& rules = space.rules();
  const double occupied_m = distance_to_state_m(grid, rules, p_map, radius_m, CellState::occupied);
  const double unknown_m = rules.blocks(CellState::unknown)
                               ? distance_to_state_m(grid, rules, p_map, radius_m, CellState::unknown)
                               : std::numeric_limits<double>::infinity();
  if (occupied_m == 0.0) return "it lies on an occupied cell";
  if (unknown_m == 0.0) return "it lies in unknown space";
  const bool occupied = occupied_m <= unknown_m;
  if (std::min(occupied_m, unknown_m) > radius_m)  // the field keeps less than the squares do: by a cell's rounding
    return fmt::format("the map, to a cell's rounding, leaves less than the {:.2f} m that the robot needs", radius_m);
  return fmt::format("{} is {:.2f} m from its centre, and the robot needs {:.2f} m",
                     occupied ? "an occupied cell" : "unknown space", std::min(occupied_m, unknown_m), radius_m);
}

std::string nearest_free_text(const DiscSpace& space, const Point& p_map, double radius_m,
                              const std::function<bool(const Point&)>& accept) {
  constexpr double kTextSearch_m = 3.0;
  const std::optional<Point> free = nearest_fit(space, p_map, radius_m, kTextSearch_m, accept);
  if (!free) return fmt::format("; there is no free place for it within {:.2f} m", kTextSearch_m);
  // To the millimetre, so that what is printed is free too.
  return fmt::format("; the nearest free place is ({:.3f}, {:.3f}), {:.2f} m away", free->x(), free->y(),
                     (*free - p_map).norm());
}

bool robot_stands_at(const WorldView& world, const Point& p_map) {
  return world.observation != nullptr && (world.pose.T_map_robot.position() - p_map).norm() <= world.grid.cell_m();
}

std::optional<OccupancyGrid> with_ground_under(const OccupancyGrid& grid, const GroundRules& rules, const Point& p_map,
                                               double radius_m) {
  return with_ground_under(grid, rules, p_map, radius_m, [&](Cell cell) {
    return distance_to_square_m(p_map, p_map, grid.centre_of(cell), grid.cell_m()) <= radius_m;
  });
}

std::optional<OccupancyGrid> with_ground_under(const OccupancyGrid& grid, const GroundRules& rules, const Point& p_map,
                                               double reach_m, const std::function<bool(Cell)>& covers) {
  if (rules.unknown == UnknownPolicy::allow) return std::nullopt;
  std::optional<OccupancyGrid> patched;
  const Cell at = grid.cell_at(p_map);
  const int reach = static_cast<int>(std::ceil(reach_m / grid.cell_m())) + 1;
  for (int y = at.y - reach; y <= at.y + reach; ++y) {
    for (int x = at.x - reach; x <= at.x + reach; ++x) {
      if (grid.state({x, y}, rules.thresholds) != CellState::unknown || !covers({x, y})) continue;
      if (!patched) patched = grid;
      patched->set_log_odds({x, y}, static_cast<LogOdds>(rules.thresholds.free_below - 1));
    }
  }
  return patched;
}

std::optional<Escape> escape_from(const OccupancyGrid& grid, const DiscSpace& space, const Point& start,
                                  double radius_m, double tolerance_m) {
  if (!space.contains(start)) return std::nullopt;
  const double occupied_m = distance_to_state_m(grid, space.rules(), start, radius_m, CellState::occupied);
  if (occupied_m <= 0.0) return std::nullopt;
  // A hair less than the start keeps, so that the start itself passes the check.
  Escape escape{start, std::min(occupied_m, radius_m) - kMinRadius_m};
  const std::optional<Point> to =
      nearest_fit(space, start, radius_m + kMinRadius_m, tolerance_m, [&](const Point& place) {
        return escape_is_free(grid, space.rules(), start, {place, escape.keep_m});
      });
  if (!to) return std::nullopt;
  escape.to = *to;
  return escape;
}

bool escape_is_free(const OccupancyGrid& grid, const GroundRules& rules, const Point& start, const Escape& escape) {
  return sweep_is_free(grid, only_occupied(rules), start, escape.to, escape.keep_m);
}

}  // namespace cairn
