#include "plugins/behaviours/lookouts/information_gain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn::behaviours {
namespace {

constexpr int kGainRays = 72;
constexpr double kMinArea_m2 = 0.01;

}  // namespace

double new_area_m2(const FreeSpace& space, const Point& viewpoint, double range_m) {
  const double step_m = space.cell_m();
  const double between_rad = 2.0 * std::numbers::pi / kGainRays;
  double area_m2 = 0.0;
  for (int ray = 0; ray < kGainRays; ++ray) {
    const Point direction(std::cos(ray * between_rad), std::sin(ray * between_rad));
    for (double r_m = step_m; r_m <= range_m; r_m += step_m) {
      const CellState state = space.state(space.cell_at(viewpoint + r_m * direction));
      if (state == CellState::occupied) break;
      if (state == CellState::unknown) area_m2 += r_m * between_rad * step_m;
    }
  }
  return area_m2;
}

double worth_of_area_m(double area_m2, double worth_m) {
  return worth_m * std::log(std::max(area_m2, kMinArea_m2));
}

}  // namespace cairn::behaviours
