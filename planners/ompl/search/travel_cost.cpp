#include "planners/ompl/search/travel_cost.hpp"

#include <limits>

#include "maps/hierarchy/route_costs.hpp"

namespace cairn {
namespace {

constexpr double kDoubt_cells = 1.5;  // by which an interpolated clearance is off at most

}  // namespace

TravelCost::TravelCost(const OccupancyGrid& grid, const DiscSpace& space, const TravelCostRules& rules)
    : grid_(grid), space_(space), rules_(rules) {
  const double open_s_per_m = rules.driving ? rules.driving->pace.min_s_per_m() : 1.0 / rules.speed_mps;
  switch (rules.objective) {
    case Objective::as_driven:
    case Objective::as_asked:
    case Objective::length:
      break;
    case Objective::time:
      base_ = open_s_per_m;
      time_ = 1.0;
      break;
    case Objective::clearance:
      clearance_ = 1.0;
      break;
    case Objective::weighted:
      base_ = rules.length_weight + rules.time_weight * open_s_per_m;
      time_ = rules.time_weight;
      clearance_ = rules.clearance_weight;
      break;
  }
  if (!rules.driving) time_ = 0.0;
}

double TravelCost::per_m_at(const Point& p_map) const {
  double per_m = base_;
  const DistanceField& field = space_.field();
  if (clearance_ > 0.0) {
    // From the middle of the cell to the nearest wall's face, which matters where cells are large.
    const double clearance_m = field.distance_m(field.cell_at(p_map)) - 0.5 * field.cell_m() - rules_.radius_m;
    per_m += clearance_ * (clearance_weight(clearance_m) - 1.0);
  }
  if (time_ > 0.0) {
    const DrivingPace& pace = rules_.driving->pace;
    per_m += time_ * (pace.s_per_m(edge_clearance_m(field, p_map, rules_.driving->radius_m)) - pace.min_s_per_m());
  }
  const bool unknown =
      rules_.unknown_weight > 1.0 && grid_.state(grid_.cell_at(p_map), space_.rules().thresholds) == CellState::unknown;
  return unknown ? per_m * rules_.unknown_weight : per_m;
}

double TravelCost::between(const Point& from, const Point& to) const {
  const double length_m = (to - from).norm();
  if (clearance_ <= 0.0 && time_ <= 0.0 && rules_.unknown_weight <= 1.0) return base_ * length_m;
  if (is_only_time()) return driving_time_s(space_.field(), from, to, *rules_.driving);
  const int steps = std::max(1, static_cast<int>(std::ceil(length_m / space_.cell_m())));
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) sum += per_m_at(from + (i + 0.5) / steps * (to - from));
  return sum * length_m / steps;
}

double TravelCost::between_or_blocked(const Point& from, const Point& to) const {
  if (!is_only_time()) return between(from, to);
  const DistanceField& field = space_.field();
  const double length_m = (to - from).norm();
  const int steps = driving_steps(field, length_m);
  const double blocked_m = -kDoubt_cells * field.cell_m();
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double clearance_m =
        edge_clearance_m(field, from + (i + 0.5) / steps * (to - from), rules_.driving->radius_m);
    if (clearance_m < blocked_m) return std::numeric_limits<double>::infinity();
    sum += rules_.driving->pace.s_per_m(clearance_m);
  }
  return sum * length_m / steps;
}

}  // namespace cairn
