#include "plugins/baselines/murphy_map/murphy_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/common/sonar_model/reading.hpp"

namespace cairn::murphy_map {

using sonar_model::Meaning;

double occupied_p(const Config& config, double cell_range_m, double bearing_rad, double half_beam_rad, double echo_m,
                  double range_m) {
  const double near = (range_m - cell_range_m) / range_m;
  const double central = half_beam_rad > 0.0 ? (half_beam_rad - std::abs(bearing_rad)) / half_beam_rad : 1.0;
  const double belief = 0.5 * (near + central);
  if (cell_range_m > echo_m + config.tolerance_m || belief < 0.0) return 0.5;
  if (cell_range_m >= echo_m - config.tolerance_m) {
    const double p = belief * config.max_occupied_p;
    return config.keep_sign ? std::max(0.5, p) : p;
  }
  return config.keep_sign ? std::min(0.5, 1.0 - belief) : 1.0 - belief;
}

void MurphyMap::integrate_reading(const RangeReading& reading, const Pose2& T_map_robot) {
  const Meaning meaning = sonar_model::meaning_of(reading);
  if (meaning == Meaning::ignored) return;
  const double range_m = std::min(reading.max_m, config_.range_m);
  const double echo_m = meaning == Meaning::echo ? reading.range_m : std::numeric_limits<double>::infinity();
  const Beam beam{T_map_robot * reading.T_robot_sensor, reading.half_beam_rad,
                  std::min(range_m, echo_m + config_.tolerance_m)};
  add_beam(beam, [&](const BeamPlace& place) {
    const double p = occupied_p(config_, place.range_m, place.bearing_rad, beam.half_beam_rad, echo_m, range_m);
    const double nat = std::clamp(std::log(p / (1.0 - p)), -100.0, 100.0);  // belief may be 0 or 1
    return static_cast<int>(std::lround(kLogOddsPerNat * nat));
  });
}

}  // namespace cairn::murphy_map
