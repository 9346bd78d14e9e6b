// The robot on its way: its outline at both ends of a path and some way apart between.
#pragma once

#include <vector>

#include "maps/geometry/pose.hpp"
#include "maps/pictures/drawing/legend.hpp"
#include "maps/pictures/drawing/map_frame.hpp"

namespace cairn::pictures {

struct RobotShape {
  std::vector<Point> polygon_m;  // in the robot's frame, x ahead; empty: a disc
  double radius_m = 0.0;         // of the disc; 0, of a point: nothing is drawn

  [[nodiscard]] double reach_m() const;  // of its farthest point from its origin
};

// Poses of a path where the robot is drawn: its ends, and between them so many at equal steps along it that neighbours
// are at least that far apart. Of a path whose poses are not all drawable, none.
[[nodiscard]] std::vector<Pose2> spread_along(const std::vector<Pose2>& path, double apart_m);

void draw_robot_along(Canvas& canvas, const MapFrame& frame, const RobotShape& shape, const std::vector<Pose2>& path);
[[nodiscard]] LegendEntry robot_entry(const RobotShape& shape);

}  // namespace cairn::pictures
