// A drive round a corridor that comes back to where it began, twice, with odometry that turns.
#pragma once

#include <vector>

#include "tests/maps/submaps/seen_room.hpp"

namespace cairn {

// A ring of corridors 2 m wide round a block of 12 x 8 m, with niches, so that its places differ.
inline std::vector<DrawnWall> ring_walls() {
  std::vector<DrawnWall> walls = walls_of({{0.0, 0.0}, {16.0, 0.0}, {16.0, 12.0}, {0.0, 12.0}});
  const std::vector<Point> block_m = {{2.0, 2.0},   {6.0, 2.0},  {6.0, 3.0},  {7.5, 3.0},  {7.5, 2.0},
                                      {14.0, 2.0},  {14.0, 7.0}, {13.0, 7.0}, {13.0, 8.0}, {14.0, 8.0},
                                      {14.0, 10.0}, {9.0, 10.0}, {9.0, 9.2},  {5.0, 9.2},  {5.0, 10.0},
                                      {2.0, 10.0},  {2.0, 5.5},  {2.8, 5.5},  {2.8, 4.0},  {2.0, 4.0}};
  for (const DrawnWall& wall : walls_of(block_m)) walls.push_back(wall);
  return walls;
}

struct DrivenScan {
  Pose2 T_map_robot;
  Pose2 T_odom_robot;
};

// Poses 0.3 m or 20 degrees apart on the middle of the corridor, `rounds` times round. Odometry turns by turn_rad_per_m
// too much, and counts (1 + scale) m for each metre.
inline std::vector<DrivenScan> ring_drive(int rounds, double turn_rad_per_m, double scale) {
  const std::vector<Point> corners_m = {{1.0, 1.0}, {15.0, 1.0}, {15.0, 11.0}, {1.0, 11.0}};
  std::vector<Pose2> truth;
  for (int i = 0; i < 4 * rounds; ++i) {
    const Point from_m = corners_m[static_cast<std::size_t>(i % 4)];
    const Point along_m = corners_m[static_cast<std::size_t>((i + 1) % 4)] - from_m;
    const double heading_rad = std::atan2(along_m.y(), along_m.x());
    const int steps = static_cast<int>(std::ceil(along_m.norm() / 0.3));
    for (int k = 0; k < steps; ++k) {
      const Point at_m = from_m + along_m * k / steps;
      truth.push_back({at_m.x(), at_m.y(), heading_rad});
    }
    for (int k = 0; k < 5; ++k)
      truth.push_back(
          {from_m.x() + along_m.x(), from_m.y() + along_m.y(), wrap_angle(heading_rad + radians(18.0 * k))});
  }
  std::vector<DrivenScan> drive;
  for (const Pose2& pose : truth) {
    const Pose2 step = drive.empty() ? Pose2{} : inverse(drive.back().T_map_robot) * pose;
    const double way_m = step.position().norm();
    const Pose2 measured{(1.0 + scale) * step.x_m, (1.0 + scale) * step.y_m, step.theta_rad + turn_rad_per_m * way_m};
    drive.push_back({pose, drive.empty() ? Pose2{} : drive.back().T_odom_robot * measured});
  }
  return drive;
}

}  // namespace cairn
