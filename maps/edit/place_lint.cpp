#include "maps/edit/place_lint.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "maps/edit/route_lint.hpp"
#include "maps/grid/travel_regions.hpp"

namespace cairn {
namespace {

// The cell nearest to a place at which the disc fits.
std::optional<Cell> nearest_fit(const DiscLattice& lattice, const OccupancyGrid& grid, const Point& place) {
  const Cell centre = grid.cell_at(place);
  if (lattice.fits(centre)) return centre;
  const int reach = static_cast<int>(std::ceil(kPlaceReach_m / grid.cell_m()));
  const CellBox near = intersected(lattice.box(), CellBox{centre, centre + Cell{1, 1}}.grown(reach));
  std::optional<Cell> best;
  double best_m = kPlaceReach_m;
  for (int y = near.min.y; y < near.max.y; ++y)
    for (int x = near.min.x; x < near.max.x; ++x) {
      const double distance_m = (grid.centre_of({x, y}) - place).norm();
      if (distance_m >= best_m || !lattice.fits({x, y})) continue;
      best_m = distance_m;
      best = Cell{x, y};
    }
  return best;
}

bool is_known_near(const OccupancyGrid& grid, const Point& place) {
  const Cell centre = grid.cell_at(place);
  const int reach = static_cast<int>(std::ceil(kPlaceReach_m / grid.cell_m()));
  const CellBox near = intersected(grid.bounds(), CellBox{centre, centre + Cell{1, 1}}.grown(reach));
  for (int y = near.min.y; y < near.max.y; ++y)
    for (int x = near.min.x; x < near.max.x; ++x)
      if (grid.state({x, y}) == CellState::free) return true;
  return false;
}

std::string why_no_place(const OccupancyGrid& grid, const Point& place, double radius_m) {
  if (!is_known_near(grid, place)) return fmt::format("nothing within {:g} m of it is known to be free", kPlaceReach_m);
  return fmt::format("the free ground within {:g} m of it has no room for a robot of {:g} m radius", kPlaceReach_m,
                     radius_m);
}

LintFinding missing_route(const LandmarkGraph& graph, LandmarkId from, LandmarkId to, double length_m,
                          double radius_m) {
  return {"missing_route",
          LintSeverity::warning,
          {from, to},
          {},
          graph.find(from)->approach_pose().position(),
          fmt::format("a robot of {:g} m radius can drive the {:.2f} m from {} to {}, but no open routes join them",
                      radius_m, length_m, full_label(*graph.find(from)), full_label(*graph.find(to))),
          "go on from this map with a mission, which joins them, or open closed routes again"};
}

}  // namespace

PlaceLint lint_places(const LandmarkGraph& graph, const OccupancyGrid& grid, const LintOptions& options) {
  PlaceLint lint;
  if (grid.bounds().empty()) return lint;
  // What routes are planned for.
  const DiscLattice lattice(DistanceField(grid, UnknownPolicy::avoid), options.radius_m + kMaxRounding_m);
  std::vector<LandmarkId> ids;
  std::vector<Cell> places;
  for (const auto& [id, landmark] : graph.landmarks()) {
    if (landmark.level != 0) continue;
    const Point at = landmark.approach_pose().position();
    if (const std::optional<Cell> place = nearest_fit(lattice, grid, at)) {
      ids.push_back(id);
      places.push_back(*place);
    } else {
      lint.no_places[id] = why_no_place(grid, at, options.radius_m);
    }
  }
  JoinedLandmarks joined = joined_by_routes(graph);
  const TravelRegions regions(lattice, places);
  for (const TravelRegions::Border& border : regions.borders()) {
    const LandmarkId from = ids[border.first];
    const LandmarkId to = ids[border.second];
    lint.on_grid.join(from, to);
    if (joined.join(from, to))
      lint.missing_routes.push_back(missing_route(graph, from, to, border.length_m, options.radius_m));
  }
  return lint;
}

std::vector<LintFinding> lint_no_places(const LandmarkGraph& graph, const PlaceLint& places) {
  std::vector<LintFinding> findings;
  for (const auto& [id, reason] : places.no_places)
    findings.push_back({"no_approach_pose",
                        LintSeverity::warning,
                        {id},
                        {},
                        graph.find(id)->T_map_landmark.position(),
                        fmt::format("{} has no approach pose: {}", full_label(*graph.find(id)), reason),
                        "explore round it, or map it again with a smaller robot"});
  return findings;
}

}  // namespace cairn
