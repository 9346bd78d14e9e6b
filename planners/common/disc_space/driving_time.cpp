#include "planners/common/disc_space/driving_time.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

double edge_clearance_m(const DistanceField& field, const Point& p_map, double radius_m) {
  const Point q = (p_map - field.origin_m()) / field.cell_m() - Point(0.5, 0.5);  // in cells, from centre to centre
  const Point low(std::floor(q.x()), std::floor(q.y()));
  const Point share = q - low;
  const Cell cell{static_cast<int>(low.x()), static_cast<int>(low.y())};
  const auto at = [&](int dx, int dy) { return static_cast<double>(field.distance_m(cell + Cell{dx, dy})); };
  const double below = at(0, 0) + share.x() * (at(1, 0) - at(0, 0));
  const double above = at(0, 1) + share.x() * (at(1, 1) - at(0, 1));
  return below + share.y() * (above - below) - 0.5 * field.cell_m() - radius_m;
}

std::optional<DrivingRules> driving_rules_of(const WorldView& world, double radius_m, double speed_mps) {
  const double robot_m = std::min(radius_m, world.robot.radius_m);
  if (!world.speed_law || robot_m <= 2.0 * kMinRadius_m || !(world.robot.max_v_mps > 0.0)) return std::nullopt;
  return DrivingRules{DrivingPace(*world.speed_law, world.robot.max_v_mps, speed_mps), robot_m};
}

int driving_steps(const DistanceField& field, double length_m) {
  constexpr double kStep_m = 0.1;
  return std::max(1, static_cast<int>(std::ceil(length_m / std::max(kStep_m, field.cell_m()))));
}

double driving_time_s(const DistanceField& field, const Point& from, const Point& to, const DrivingRules& rules) {
  const double length_m = (to - from).norm();
  const int steps = driving_steps(field, length_m);
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
    sum += rules.pace.s_per_m(edge_clearance_m(field, from + (i + 0.5) / steps * (to - from), rules.radius_m));
  return sum * length_m / steps;
}

double driving_time_s(const DistanceField& field, const std::vector<Point>& route, const DrivingRules& rules) {
  double sum_s = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) sum_s += driving_time_s(field, route[i - 1], route[i], rules);
  return sum_s;
}

}  // namespace cairn
