// Maps as ASCII drawings, for tests of planners and for their failures.
//
//   '#' occupied   '.' free   '?' unknown   any letter: free, and a place of that name
//
// The first line is the top row. Each character is a block of `scale` x `scale` cells.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/contracts/path_planner.hpp"
#include "maps/geometry/segments.hpp"

namespace cairn::test {

struct DrawnWorld {
  OccupancyGrid grid{0.1};
  LandmarkGraph graph;
  RobotModel robot;
  std::map<char, Point> places;  // centres of the lettered blocks
  int scale = 1;

  [[nodiscard]] WorldView view() const { return {grid, graph, robot, {}, 0.0, nullptr, 0.0}; }
  [[nodiscard]] Pose2 pose(char place) const { return {places.at(place).x(), places.at(place).y(), 0.0}; }
  [[nodiscard]] PathRequest request(char from, char to, double radius_m) const;
  // Sets the blocks with this letter, and the block of cells under it, to a state.
  void fill(char place, CellState state);
};

[[nodiscard]] DrawnWorld drawn_world(const std::string& drawing, double cell_m = 0.1, int scale = 1);
// The map again, with the cells that a path crosses as '*'.
[[nodiscard]] std::string drawing_of(const OccupancyGrid& grid, const std::vector<Pose2>& path);

// Distance from a path to the nearest cell that is not free (or, with only_occupied, not occupied), by
// brute force over all cells and closely spaced points: an oracle within step_m.
[[nodiscard]] double distance_by_brute_force(const OccupancyGrid& grid, const std::vector<Pose2>& path,
                                             bool only_occupied = false, double step_m = 0.005);

}  // namespace cairn::test
