// What a robot that does not know where it is has seen around itself: points of the small map that it has drawn since
// it began, whatever sensors that map is made of.
#pragma once

#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

struct Surroundings {
  std::vector<Point> echoes_m;  // where something is, as seen from the robot
  std::vector<Point> free_m;    // where nothing is
};

// At most so many points of each kind, evenly thinned. Distances between free points and what is occupied are at least
// two cells of the raster. Points lie in the middle of the squares of a raster: a square is occupied when one of its
// cells is, free when none is and half of them are free.
struct SurroundingsSettings {
  double raster_m = 0.1;
  double free_raster_m = 0.3;
  std::size_t echoes_at_most = 500;
  std::size_t free_at_most = 250;
};

// seen: a map in any frame. O(cells).
[[nodiscard]] Surroundings surroundings_of(const OccupancyGrid& seen, const Pose2& T_seen_robot,
                                           const SurroundingsSettings& settings = {});

// The middles of occupied and of free squares, in the grid's frame; row by row.
struct RasterPoints {
  std::vector<Point> occupied_m;
  std::vector<Point> free_m;
};
// The raster has squares at multiples of raster_m, as likelihood fields have.
[[nodiscard]] RasterPoints raster_points(const OccupancyGrid& grid, double raster_m);

}  // namespace cairn
