// Scans of rooms with straight walls, taken by rays: what submaps are tested with.
#pragma once

#include <limits>
#include <random>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

struct DrawnWall {
  Point from_m{0.0, 0.0};
  Point to_m{0.0, 0.0};
};

inline std::vector<DrawnWall> walls_of(const std::vector<Point>& corners_m) {
  std::vector<DrawnWall> walls;
  for (std::size_t i = 0; i < corners_m.size(); ++i)
    walls.push_back({corners_m[i], corners_m[(i + 1) % corners_m.size()]});
  return walls;
}

// An L, so that no two of its places look alike.
inline std::vector<DrawnWall> drawn_room() {
  return walls_of({{0.0, 0.0}, {8.0, 0.0}, {8.0, 3.0}, {5.0, 3.0}, {5.0, 5.0}, {0.0, 5.0}});
}

inline double range_to(const std::vector<DrawnWall>& walls, const Point& from_m, const Point& direction) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const DrawnWall& wall : walls) {
    const Point along_m = wall.to_m - wall.from_m;
    const double turned = cross(direction, along_m);
    if (std::abs(turned) < 1e-12) continue;
    const double range_m = cross(wall.from_m - from_m, along_m) / turned;
    const double part = cross(wall.from_m - from_m, direction) / turned;
    if (range_m > 0.0 && part >= 0.0 && part <= 1.0) nearest_m = std::min(nearest_m, range_m);
  }
  return nearest_m;
}

// Echoes all round, seen from the robot, with errors of that deviation along the rays.
inline std::vector<Point> seen_from(const std::vector<DrawnWall>& walls, const Pose2& T_map_robot, int beams,
                                    double noise_m, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> error_m(0.0, noise_m > 0.0 ? noise_m : 1e-9);
  std::vector<Point> points_m;
  for (int i = 0; i < beams; ++i) {
    const double bearing_rad = 2.0 * std::numbers::pi * i / beams;
    const double range_m = range_to(walls, T_map_robot.position(), unit_vector(T_map_robot.theta_rad + bearing_rad));
    if (std::isfinite(range_m)) points_m.emplace_back((range_m + error_m(random)) * unit_vector(bearing_rad));
  }
  return points_m;
}

}  // namespace cairn
