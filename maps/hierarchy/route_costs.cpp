#include "maps/hierarchy/route_costs.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "maps/geometry/segments.hpp"
#include "maps/grid/distance_field.hpp"

namespace cairn {
namespace {

constexpr double kWide_m = 0.5;        // clearance of the robot's edge from which a metre counts as one
constexpr double kNarrowWeight = 4.0;  // what a metre without any clearance counts on top

double turning_of(const std::vector<Pose2>& trajectory) {
  double turning_rad = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    turning_rad += std::abs(wrap_angle(trajectory[i].theta_rad - trajectory[i - 1].theta_rad));
  return turning_rad;
}

double time_of(const Route& route, const RouteCostRules& rules) {
  const double speed_mps = std::min(rules.speed_mps, route.speed_limit_mps.value_or(rules.speed_mps));
  const double length_m = route.trajectory.empty() ? route.cost_m : length_of(route.trajectory);
  return length_m / speed_mps + turning_of(route.trajectory) / rules.turn_radps;
}

double weight_at(const Point& p_map, const DistanceField& field, double radius_m) {
  return clearance_weight(field.distance_m(field.cell_at(p_map)) - radius_m);
}

double crampedness_of(const Route& route, const DistanceField& field, double radius_m) {
  if (route.trajectory.empty()) return route.cost_m;
  double sum_m = 0.0;
  for (std::size_t i = 1; i < route.trajectory.size(); ++i) {
    const Point from = route.trajectory[i - 1].position();
    const Point along = route.trajectory[i].position() - from;
    const int steps = std::max(1, static_cast<int>(std::ceil(along.norm() / field.cell_m())));
    for (int s = 0; s < steps; ++s)
      sum_m += weight_at(from + (s + 0.5) / steps * along, field, radius_m) * along.norm() / steps;
  }
  return sum_m;
}

}  // namespace

std::string_view name_of(CostKind kind) {
  return kind == CostKind::length ? "length" : kind == CostKind::time ? "time" : "clearance";
}

std::string_view unit_of(CostKind kind) {
  return kind == CostKind::time ? "s" : "m";
}

double clearance_weight(double clearance_m) {
  return 1.0 + kNarrowWeight * std::clamp(1.0 - clearance_m / kWide_m, 0.0, 1.0);
}

RouteCost route_cost(CostKind kind, const RouteCostRules& rules) {
  if (kind == CostKind::time) return [rules](const Route& route) { return time_of(route, rules); };
  if (kind == CostKind::clearance && rules.grid != nullptr && !rules.grid->bounds().empty())
    return [field = std::make_shared<const DistanceField>(*rules.grid, UnknownPolicy::avoid),
            radius_m = rules.radius_m](const Route& route) { return crampedness_of(route, *field, radius_m); };
  return cost_by_length;
}

}  // namespace cairn
