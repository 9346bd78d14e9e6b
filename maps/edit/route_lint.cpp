#include "maps/edit/route_lint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "maps/geometry/segments.hpp"
#include "maps/grid/swept_disc.hpp"

namespace cairn {
namespace {

constexpr double kEnds_m = 0.1;          // a trajectory's end may be this far from its landmark's standing place
constexpr double kRounding = 1e-9;       // relative, of costs
constexpr int kFarOutside_cells = 1024;  // what is farther from the grid is not swept: it is unknown

// The earliest blocked cells of one leg, one a state.
struct LegBlockages {
  std::optional<Blockage> occupied;
  std::optional<Blockage> unknown;
};

LegBlockages blockages_on_leg(const OccupancyGrid& grid, const Point& from, const Point& to, double radius_m) {
  LegBlockages found;
  double occupied_at = 2.0;
  double unknown_at = 2.0;
  const Lattice lattice{grid.origin_m(), grid.cell_m()};
  const double reach_m = std::max(radius_m, kMinRadius_m);
  (void)any_cell_near(lattice, from, to, reach_m, [&](Cell cell) {
    const CellState state = grid.state(cell);
    if (state == CellState::free) return false;
    const Point at_m = lattice.centre_of(cell);
    const double t = share_along(at_m, from, to);
    double& first_at = state == CellState::occupied ? occupied_at : unknown_at;
    if (t >= first_at || distance_to_square_m(from, to, at_m, lattice.cell_m) >= reach_m) return false;
    first_at = t;
    (state == CellState::occupied ? found.occupied : found.unknown) = Blockage{at_m, state};
    return false;
  });
  return found;
}

std::string name_of_route(const LandmarkGraph& graph, const Route& route) {
  return fmt::format("route {}, {} -> {},", route.id, full_label(*graph.find(route.from)),
                     full_label(*graph.find(route.to)));
}

// What can be wrong with one route.
class RouteLint {
 public:
  RouteLint(const LandmarkGraph& graph, const OccupancyGrid& grid, const LintOptions& options)
      : graph_(graph), grid_(grid), options_(options), has_grid_(!grid.bounds().empty()) {}

  void look_at(const Route& route) {
    if (route.closed) {
      add("closed_route", LintSeverity::note, route, graph_.find(route.from)->approach_pose().position(), "is closed",
          "open it again when its way is free");
      return;
    }
    look_at_cost(route);
    if (route.trajectory.empty()) return;
    look_at_ends(route);
    if (!has_grid_ || route.level != 0)
      unchecked_.push_back(route.id);
    else
      check_trajectory(route);
  }

  std::vector<LintFinding> take() && {
    if (!unchecked_.empty())
      findings_.push_back({"unchecked_routes",
                           LintSeverity::note,
                           {},
                           unchecked_,
                           graph_.find(graph_.find_route(unchecked_.front())->from)->approach_pose().position(),
                           fmt::format("there is no grid to check {} trajector{} on", unchecked_.size(),
                                       unchecked_.size() == 1 ? "y" : "ies"),
                           "map the place, or import a grid of it"});
    return std::move(findings_);
  }

 private:
  void add(std::string kind, LintSeverity severity, const Route& route, const Point& at_m, const std::string& what,
           std::string advice) {
    findings_.push_back({std::move(kind),
                         severity,
                         {route.from, route.to},
                         {route.id},
                         at_m,
                         name_of_route(graph_, route) + " " + what,
                         std::move(advice)});
  }

  void look_at_cost(const Route& route) {
    const Point from = graph_.find(route.from)->approach_pose().position();
    const double straight_m = (graph_.find(route.to)->approach_pose().position() - from).norm();
    if (route.cost_m < straight_m * (1.0 - kRounding))
      add("too_cheap", LintSeverity::note, route, from,
          fmt::format("costs {:.2f} m, less than the straight line of {:.2f} m between its ends", route.cost_m,
                      straight_m),
          "a search that estimates by straight lines would not find the cheapest path; Dijkstra's does");
  }

  void look_at_ends(const Route& route) {
    const Landmark& from = *graph_.find(route.from);
    const Landmark& to = *graph_.find(route.to);
    const double begin_m = (route.trajectory.front().position() - from.approach_pose().position()).norm();
    const double end_m = (route.trajectory.back().position() - to.approach_pose().position()).norm();
    if (begin_m <= kEnds_m && end_m <= kEnds_m) return;
    const bool at_begin = begin_m > kEnds_m;
    add("loose_ends", LintSeverity::warning, route,
        (at_begin ? route.trajectory.front() : route.trajectory.back()).position(),
        fmt::format("begins {:.2f} m from where a robot stands at {} and ends {:.2f} m from where it stands at {}",
                    begin_m, label_of(from), end_m, label_of(to)),
        "plan it anew: a landmark has moved since, or the ends are swapped");
  }

  void check_trajectory(const Route& route) {
    const std::optional<Blockage> blocked = blockage_on(route.trajectory, grid_, options_.radius_m);
    if (!blocked) return;
    const bool occupied = blocked->by == CellState::occupied;
    add("blocked_route", occupied ? LintSeverity::error : LintSeverity::warning, route, blocked->at_m,
        fmt::format("is not free for a robot of {:g} m radius: the cell at ({:.2f}, {:.2f}) m is {}", options_.radius_m,
                    blocked->at_m.x(), blocked->at_m.y(), occupied ? "occupied" : "unknown"),
        occupied ? "close it, or plan it anew round what stands there" : "explore there, or plan it anew");
  }

  const LandmarkGraph& graph_;
  const OccupancyGrid& grid_;
  const LintOptions& options_;
  bool has_grid_;
  std::vector<RouteId> unchecked_;
  std::vector<LintFinding> findings_;
};

}  // namespace

std::optional<Blockage> blockage_on(std::span<const Pose2> trajectory, const OccupancyGrid& grid, double radius_m) {
  std::optional<Blockage> unknown;
  const CellBox swept = grid.bounds().grown(kFarOutside_cells);
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const Point from = trajectory[i == 0 ? 0 : i - 1].position();
    const Point to = trajectory[i].position();
    const auto far_off = [&](const Point& p) { return !swept.contains(grid.cell_at(p)); };
    if (far_off(from) || far_off(to)) {
      if (!unknown) unknown = Blockage{far_off(from) ? from : to, CellState::unknown};
      continue;
    }
    const LegBlockages leg = blockages_on_leg(grid, from, to, radius_m);
    if (leg.occupied) return leg.occupied;
    if (!unknown) unknown = leg.unknown;
  }
  return unknown;
}

std::vector<LintFinding> lint_routes(const LandmarkGraph& graph, const OccupancyGrid& grid,
                                     const LintOptions& options) {
  RouteLint lint(graph, grid, options);
  for (const auto& [id, route] : graph.routes()) lint.look_at(route);
  return std::move(lint).take();
}

std::string full_label(const Landmark& landmark) {
  const std::string id = fmt::format("L{}", landmark.id);
  return landmark.name.empty() ? id : fmt::format("{} ({})", landmark.name, id);
}

}  // namespace cairn
