#include "plugins/baselines/bayes_map/bayes_map.hpp"

#include <cmath>

#include "plugins/common/sonar_model/reading.hpp"

namespace cairn::bayes_map {

using sonar_model::Meaning;

void BayesMap::integrate_reading(const RangeReading& reading, const Pose2& T_map_robot) {
  const Meaning meaning = sonar_model::meaning_of(reading);
  if (meaning == Meaning::ignored) return;
  const bool echo = meaning == Meaning::echo;
  const Beam beam{T_map_robot * reading.T_robot_sensor, reading.half_beam_rad,
                  echo ? beam_model_.reach_of_echo_m(reading.range_m) : beam_model_.reach_of_silence_m(reading.max_m)};
  add_beam(beam, [&](const BeamPlace& place) {
    const double alpha = beam_model_.alpha(place.range_m, place.bearing_rad, beam.half_beam_rad);
    const double lambda = echo ? beam_model_.lambda_of_echo(alpha, place.range_m, reading.range_m)
                               : beam_model_.lambda_of_silence(alpha, place.range_m, reading.max_m);
    return static_cast<int>(std::lround(kLogOddsPerNat * std::log(lambda)));
  });
}

}  // namespace cairn::bayes_map
