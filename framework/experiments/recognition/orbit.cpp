#include "framework/experiments/recognition/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/experiments/recognition/places.hpp"

namespace cairn {
namespace {

double bearing(const Point& from, const Point& to) {
  return std::atan2(to.y() - from.y(), to.x() - from.x());
}

}  // namespace

std::vector<OrbitSample> degrees_along_orbit(const ExperimentConfig& config, const World& world, const Point& start_m,
                                             const std::vector<DegreeSample>& samples) {
  const auto object = std::ranges::find(world.objects, config.orbit->around, &WorldObject::category);
  const Point centre_m = object->T_map_object.position();
  std::vector<OrbitSample> orbit;
  double last_rad = bearing(centre_m, start_m);
  double angle_rad = 0.0;
  for (const DegreeSample& sample : samples) {
    const double here_rad = bearing(centre_m, sample.robot_m);
    angle_rad += wrap_angle(here_rad - last_rad);
    last_rad = here_rad;
    if ((sample.region_centre_m - centre_m).norm() > config.looks_within_m) continue;
    if (std::abs(angle_rad) >= 2.0 * std::numbers::pi) break;
    OrbitSample& on_orbit = orbit.emplace_back();
    on_orbit.angle_rad = std::abs(angle_rad);
    on_orbit.categories = degrees_in_order(sample.degrees, config.categories);
    for (const TemplateDegree& t : sample.templates)
      if (t.category == config.orbit->around)
        on_orbit.templates[static_cast<int>(std::lround(degrees(t.orientation_rad)))] = t.degree;
  }
  return orbit;
}

}  // namespace cairn
