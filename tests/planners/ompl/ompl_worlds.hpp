// Drawings that the tests of the OMPL planner share.
#pragma once

#include "framework/contracts/path_planner.hpp"
#include "planners/ompl/ompl_planner.hpp"
#include "tests/planners/drawn_world.hpp"

namespace cairn::test {

inline constexpr const char* kOffice =
    "########################\n"
    "#..........#...........#\n"
    "#..........#...........#\n"
    "#..A.......#......B....#\n"
    "#..........#...........#\n"
    "#..........#...........#\n"
    "######.....#....########\n"
    "#......................#\n"
    "#......................#\n"
    "#......................#\n"
    "#......................#\n"
    "#..C.......#......D....#\n"
    "#..........#...........#\n"
    "########################\n";

// A path that keeps the radius everywhere but on its first segment when that is an escape.
inline bool keeps_clear(const OccupancyGrid& grid, const std::vector<Pose2>& path, double radius_m,
                        bool only_occupied = false) {
  return distance_by_brute_force(grid, path, only_occupied, 0.01) >= radius_m - 1e-9;
}

}  // namespace cairn::test
