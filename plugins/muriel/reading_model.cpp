#include "plugins/muriel/reading_model.hpp"

#include "plugins/common/sonar_model/reading.hpp"

namespace cairn::muriel {
namespace {

double reach_m(const Config& config, double range_m) {
  const double end_m = config.alpha_range_m;
  if (range_m + kReach_sigmas * config.delta(end_m) >= end_m) return end_m;
  return (range_m + kReach_sigmas * config.delta_m) / (1.0 - kReach_sigmas * config.delta_per_m);
}

}  // namespace

std::optional<PlacedReading> placed(const Config& config, const RangeReading& reading, const Pose2& T_map_robot) {
  const sonar_model::Meaning meaning = sonar_model::meaning_of(reading);
  if (meaning == sonar_model::Meaning::ignored) return std::nullopt;
  PlacedReading result;
  result.is_echo = meaning == sonar_model::Meaning::echo;
  result.range_m = result.is_echo ? reading.range_m : reading.max_m;
  result.is_light = reading.half_beam_rad <= 0.0;
  const double reach = reach_m(config, result.range_m);
  const bool is_ray = 2.0 * reach * reading.half_beam_rad < config.cell_m;
  result.beam = {T_map_robot * reading.T_robot_sensor, is_ray ? 0.0 : reading.half_beam_rad, reach};
  return result;
}

double KnownTargets::specular_p(const Config& config, bool is_echo) const {
  double direct = 1.0;
  double sources_per_m = config.false_echo_per_m;
  for (int k = 0; k < sectors_; ++k) {
    direct *= 1.0 - blocking_[static_cast<std::size_t>(k)];
    sources_per_m += density_per_m_[static_cast<std::size_t>(k)];
  }
  if (is_echo) direct *= sources_per_m;
  const double mirrored = config.specular_prior * (is_echo ? config.specular_per_m : 1.0);
  const double either = mirrored + (1.0 - config.specular_prior) * direct;
  return either > 0.0 ? mirrored / either : 0.0;
}

}  // namespace cairn::muriel
