#include "plugins/behaviours/lookouts/look_closer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "plugins/common/motion/path.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;

double sector_angle(int sector) {
  return kFullTurn * sector / kOrbitSectors;
}

int sector_of(const Point& from_centre) {
  const double turns = std::atan2(from_centre.y(), from_centre.x()) / kFullTurn;
  return ((static_cast<int>(std::lround(turns * kOrbitSectors)) % kOrbitSectors) + kOrbitSectors) % kOrbitSectors;
}

struct NearestCell {
  Cell cell;
  double distance_m = std::numeric_limits<double>::infinity();
};

NearestCell nearest_cell(const FreeSpace& space, const CellGroup& object, const Point& p) {
  NearestCell best;
  for (const Cell c : object) {
    const double distance_m = (space.centre_of(c) - p).norm();
    if (distance_m < best.distance_m) best = {c, distance_m};
  }
  return best;
}

bool is_near_any(const Point& p, const std::vector<Point>& points, double within_m) {
  return std::any_of(points.begin(), points.end(), [&](const Point& q) { return (p - q).norm() < within_m; });
}

// Distances to the object to try, the wanted one first, then further and nearer by turns.
std::vector<double> tried_distances(const FreeSpace& space, const OrbitSettings& settings) {
  const double step_m = space.cell_m();
  const double wanted_m = std::max(settings.distance_m, space.min_distance_m());
  const double max_m = std::max(wanted_m, settings.look_closer_m - step_m);
  std::vector<double> distances{wanted_m};
  for (int i = 1; wanted_m - i * step_m >= space.min_distance_m() || wanted_m + i * step_m <= max_m; ++i) {
    if (wanted_m - i * step_m >= space.min_distance_m()) distances.push_back(wanted_m - i * step_m);
    if (wanted_m + i * step_m <= max_m) distances.push_back(wanted_m + i * step_m);
  }
  return distances;
}

// The point of a ray from the centre that is this far from the object, from outside.
Point point_on_ray(const FreeSpace& space, const CellGroup& object, const Orbit& orbit, int sector, double distance_m) {
  const Point direction{std::cos(sector_angle(sector)), std::sin(sector_angle(sector))};
  double r_m = orbit.radius_m + distance_m;
  while (r_m > 0.0) {
    const double now_m = nearest_cell(space, object, orbit.centre + direction * r_m).distance_m;
    if (now_m <= distance_m + 0.25 * space.cell_m()) break;
    r_m -= std::max(0.5 * (now_m - distance_m), 0.25 * space.cell_m());
  }
  return orbit.centre + direction * r_m;
}

Sector look_along(const FreeSpace& space, const CellGroup& object, const Orbit& orbit, int sector,
                  const std::vector<Point>& avoid, const OrbitSettings& settings) {
  Sector result;
  for (const double distance_m : tried_distances(space, settings)) {
    const Point p = point_on_ray(space, object, orbit, sector, distance_m);
    const Cell cell = space.cell_at(p);
    if (space.reaches(cell) && !is_near_any(p, avoid, settings.object.avoid_m) &&
        space.sees(p, nearest_cell(space, object, p).cell))
      return {SectorState::open, cell};
    if (space.state(cell) != CellState::unknown && space.distance_m(cell) < space.min_distance_m())
      result.state = SectorState::blocked;
    if (is_near_any(p, avoid, settings.object.avoid_m)) result.state = SectorState::blocked;
  }
  return result;
}

// Whether the robot can come near at all: most of what looks like an object in a noisy map is out of reach.
bool is_near_reach(const FreeSpace& space, const Orbit& orbit, const OrbitSettings& settings) {
  const double reach_m = orbit.radius_m + settings.look_closer_m;
  const Cell low = space.cell_at(orbit.centre - Point{reach_m, reach_m});
  const Cell high = space.cell_at(orbit.centre + Point{reach_m, reach_m});
  for (int y = low.y; y <= high.y; y += 3)
    for (int x = low.x; x <= high.x; x += 3)
      if (space.reaches({x, y})) return true;
  return false;
}

void mark_covered(const FreeSpace& space, const CellGroup& object, std::span<const Pose2> trace, double look_closer_m,
                  Orbit& orbit) {
  for (const Pose2& pose : trace) {
    const Point p = pose.position();
    const Point from_centre = p - orbit.centre;
    if (from_centre.norm() > orbit.radius_m + look_closer_m) continue;
    Sector& sector = orbit.sectors[static_cast<std::size_t>(sector_of(from_centre))];
    if (sector.state == SectorState::covered) continue;
    const NearestCell nearest = nearest_cell(space, object, p);
    if (nearest.distance_m <= look_closer_m && space.sees(p, nearest.cell)) sector.state = SectorState::covered;
  }
}

}  // namespace

void ObjectSettings::describe(Fields<ObjectSettings>& fields) {
  using C = ObjectSettings;
  fields.integer("gap_cells", &C::gap_cells, {1.0, 100.0}, "gaps in an outline up to this are part of one object");
  fields.integer("min_cells", &C::min_cells, {1.0, 1e6}, "fewer occupied cells are no object");
  fields.integer("max_hidden_sectors", &C::max_hidden_sectors, {0.0, 24.0},
                 "an object stands free when at most so many of 24 directions round it are unknown");
  fields.integer("min_open_sectors", &C::min_open_sectors, {0.0, 24.0}, "and the robot can stand in at least so many");
  fields.number("avoid_m", &C::avoid_m, {0.0, 10.0}, "m",
                "places on an orbit this near to one that failed are left out");
}

std::vector<Cell> unseen(const FreeSpace& space, const std::vector<Cell>& cells, const std::vector<Pose2>& trace,
                         const Sight& sight, CellSet& seen) {
  const bool looks_all_round = sight.to_the_side_rad >= std::numbers::pi;
  std::vector<Cell> left;
  for (const Cell cell : cells) {
    if (seen.contains(cell)) continue;
    const Point p = space.centre_of(cell);
    const bool now_seen = std::any_of(trace.rbegin(), trace.rend(), [&](const Pose2& from) {
      return (p - from.position()).squaredNorm() <= sight.within_m * sight.within_m &&
             (looks_all_round || std::abs(motion::heading_error(from, p)) <= sight.to_the_side_rad) &&
             space.sees(from.position(), cell);
    });
    if (now_seen) {
      seen.insert(cell);
    } else {
      left.push_back(cell);
    }
  }
  return left;
}

int Orbit::count(SectorState state) const {
  return static_cast<int>(
      std::count_if(sectors.begin(), sectors.end(), [state](const Sector& s) { return s.state == state; }));
}

bool Orbit::is_round_trip(const ObjectSettings& settings) const {
  return count(SectorState::hidden) <= settings.max_hidden_sectors &&
         count(SectorState::open) + count(SectorState::covered) >= settings.min_open_sectors;
}

std::vector<CellGroup> compact_objects(const FreeSpace& space, double largest_object_m,
                                       const ObjectSettings& settings) {
  std::vector<Cell> occupied;
  const CellBox box = space.box();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (space.state({x, y}) == CellState::occupied) occupied.push_back({x, y});

  std::vector<CellGroup> groups = grouped(occupied, settings.gap_cells);
  std::erase_if(groups, [&](const CellGroup& group) {
    CellBox extent;
    for (const Cell c : group) extent = united(extent, {c, c + Cell{1, 1}});
    return static_cast<int>(group.size()) < settings.min_cells ||
           std::max(extent.width(), extent.height()) * space.cell_m() > largest_object_m;
  });
  return groups;
}

Orbit orbit_round(const FreeSpace& space, const CellGroup& object, std::span<const Pose2> trace,
                  const std::vector<Point>& avoid, const OrbitSettings& settings) {
  Orbit orbit;
  CellBox extent;
  for (const Cell c : object) extent = united(extent, {c, c + Cell{1, 1}});
  orbit.centre = 0.5 * (space.centre_of(extent.min) + space.centre_of(extent.max - Cell{1, 1}));
  for (const Cell c : object) orbit.radius_m = std::max(orbit.radius_m, (space.centre_of(c) - orbit.centre).norm());

  orbit.sectors.resize(kOrbitSectors);
  if (!is_near_reach(space, orbit, settings)) return orbit;
  mark_covered(space, object, trace, settings.look_closer_m, orbit);
  for (int i = 0; i < kOrbitSectors; ++i) {
    Sector& sector = orbit.sectors[static_cast<std::size_t>(i)];
    if (sector.state != SectorState::covered) sector = look_along(space, object, orbit, i, avoid, settings);
  }
  return orbit;
}

OrbitRoute orbit_route(const FreeSpace& space, const Orbit& orbit, const Pose2& T_map_robot) {
  const auto sector = [&](int i) -> const Sector& {
    return orbit.sectors[static_cast<std::size_t>(((i % kOrbitSectors) + kOrbitSectors) % kOrbitSectors)];
  };
  OrbitRoute route;
  route.cost_m = std::numeric_limits<double>::infinity();
  int first = -1;
  for (int i = 0; i < kOrbitSectors; ++i) {
    if (sector(i).state != SectorState::open || space.cost_m(sector(i).lookout) >= route.cost_m) continue;
    first = i;
    route.cost_m = space.cost_m(sector(i).lookout);
  }
  if (first < 0) return route;
  route.first = sector(first).lookout;
  route.path = space.path_to(route.first);
  route.path_m = length_of(route.path);

  const auto run = [&](int step) {
    int length = 0;
    while (length < kOrbitSectors - 1 && sector(first + step * (length + 1)).state == SectorState::open) ++length;
    return length;
  };
  // The direction of an anticlockwise orbit; does the robot look along it already?
  const double along_rad = sector_angle(first) + std::numbers::pi / 2.0;
  const bool heads_anticlockwise = std::cos(T_map_robot.theta_rad - along_rad) >= 0.0;
  const int ahead = run(1);
  const int back = run(-1);
  const int step = ahead > back || (ahead == back && heads_anticlockwise) ? 1 : -1;
  for (int i = 1; i <= std::max(ahead, back); ++i) {
    const Point next = space.centre_of(sector(first + step * i).lookout);
    if (!space.line_is_open(route.path.back(), next)) break;
    route.path.push_back(next);
  }
  return route;
}

}  // namespace cairn::behaviours
