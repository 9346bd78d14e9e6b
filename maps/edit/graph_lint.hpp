// What is doubtful about a landmark graph: places that cannot be reached or left, duplicates, routes that are
// no longer free, names that mislead.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

enum class LintSeverity {
  note,     // may well be meant so
  warning,  // a robot will not find or not use something that is there
  error,    // a robot that trusts the graph gets stuck
};

struct LintFinding {
  std::string kind;  // stable: "trap", "blocked_route", ...
  LintSeverity severity = LintSeverity::note;
  std::vector<LandmarkId> landmarks;
  std::vector<RouteId> routes;
  Point at_m{0.0, 0.0};
  std::string sentence;  // what is wrong
  std::string advice;    // what to do about it
};

struct LintOptions {
  double radius_m = 0.25;  // of the robot that drives the routes; at least 0
  double near_m = 0.4;     // landmarks of one category this near to each other are taken for one; at least 0
};

// Errors first, then warnings, then notes; of one severity by kind, then by id. The grid is that of level 0.
// Time: O((n + m) log n), the cells under the trajectories, and O(cells log cells) of the grid. Kinds:
//   trap, no_way_in, cut_off, isolated   what parts_of() says, one finding a part
//   missing_route                        the robot can drive between two landmarks, but no open routes join them
//   no_approach_pose                     of a graph without routes: no place to stand at a landmark; isolated says it,
//   too same_place, near_duplicate           one finding a group; the first whatever the category blocked_route the
//   robot's disc touches a cell that is occupied (error) or unknown unchecked_routes                     there is no
//   grid to check the trajectories on loose_ends                           a trajectory does not begin and end where
//   its landmarks are too_cheap                            costs less than the straight line closed_route
//   name_taken_twice, misread_name       a name that stands for something else, too
[[nodiscard]] std::vector<LintFinding> lint_graph(const LandmarkGraph& graph, const OccupancyGrid& grid,
                                                  const LintOptions& options);

[[nodiscard]] std::string_view name_of(LintSeverity severity);

}  // namespace cairn
