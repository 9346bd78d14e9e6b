// Small worlds and a plain robot for the tests of this folder.
#pragma once

#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/world.hpp"

namespace cairn {

inline constexpr double kAlways_s = 1e9;  // commands that are never renewed

}  // namespace cairn

namespace cairn::testing {

inline WorldWall wall(std::vector<Point> points_m, Surface surface = Surface::smooth) {
  return {std::move(points_m), surface};
}

// A smooth wall 2 m wide through (distance, 0) whose normal is turned away from the x axis by the angle.
inline World tilted_wall(double distance_m, double tilt_deg, Surface surface = Surface::smooth) {
  const Point along(-std::sin(radians(tilt_deg)), std::cos(radians(tilt_deg)));
  const Point middle(distance_m, 0.0);
  World world;
  world.walls = {wall({middle - along, middle + along}, surface)};
  return world;
}

inline World room(double width_m, double height_m, Surface surface = Surface::smooth) {
  World world;
  world.max_m = {width_m, height_m};
  world.walls = {wall({{0, 0}, {width_m, 0}, {width_m, height_m}, {0, height_m}, {0, 0}}, surface)};
  return world;
}

inline WorldObject circle_at(const Point& at_m, double diameter_m, Surface surface = Surface::rough) {
  return {"", Contour::circle(diameter_m), {at_m.x(), at_m.y(), 0.0}, surface};
}

inline WorldObject square_at(const Point& at_m, double side_m, double angle_deg, Surface surface = Surface::rough) {
  const double h = 0.5 * side_m;
  return {"square",
          Contour::polygon({{-h, -h}, {h, -h}, {h, h}, {-h, h}}),
          {at_m.x(), at_m.y(), radians(angle_deg)},
          surface};
}

// No errors of any kind; one sonar that looks ahead from the middle.
inline RobotModel exact_robot() {
  RobotModel robot;
  robot.sonars = {SonarModel{}};
  robot.range_error = {0.0, 0.0, 0.0, 0.0};
  return robot;
}

}  // namespace cairn::testing
