#include "plugins/muriel/plain_muriel.hpp"

#include <cmath>
#include <numbers>

#include "maps/geometry/segments.hpp"
#include "plugins/common/sonar_model/reading.hpp"

namespace cairn::muriel {
namespace {

// visit(cell, place, alpha) for every cell of the beam.
template <class Visit>
void for_each_cell(const Config& config, const PlacedReading& reading, const std::vector<CellSpan>& spans,
                   const Visit& visit) {
  const BeamFrame frame(reading.beam, config.cell_m);
  for (const CellSpan& span : spans)
    for (int x = span.x_begin; x < span.x_end; ++x) {
      const BeamPlace place = frame.place_of({x, span.y});
      if (!place.is_inside) continue;
      visit(Cell{x, span.y}, place, config.alpha(place.range_m, place.bearing_rad, reading.beam.half_beam_rad));
    }
}

double specular_p(const Config& config, const PlacedReading& reading, const OccupancyGrid& grid,
                  const std::vector<CellSpan>& spans) {
  const LogOdds believed = log_odds_of(config.believed_p);
  const double half_beam = reading.beam.half_beam_rad;
  KnownTargets targets(config.specular_sectors);
  for_each_cell(config, reading, spans, [&](Cell cell, const BeamPlace& place, double alpha) {
    const LogOdds log_odds = grid.log_odds(cell);
    if (log_odds < believed) return;
    const double answer = alpha * probability_of(log_odds);
    const double delta = config.delta(place.range_m);
    const double off_axis = half_beam > 0.0 ? place.bearing_rad / half_beam : 0.0;
    if (place.range_m < reading.range_m - 3.0 * delta) targets.add_blocker(off_axis, answer);
    if (!reading.is_echo) return;
    const double z = (reading.range_m - place.range_m) / delta;
    targets.add_source(off_axis, answer * std::exp(-0.5 * z * z) / (delta * std::sqrt(2.0 * std::numbers::pi)));
  });
  return targets.specular_p(config, reading.is_echo);
}

}  // namespace

void integrate_plainly(const Config& config, const PlacedReading& reading, OccupancyGrid& grid, IndependenceLog& log,
                       std::vector<CellSpan>& spans, std::vector<CellSpan>& changed) {
  if (!grid.can_include(reading.beam.T_map_sensor.position(), reading.beam.reach_m)) return;
  spans_over(reading.beam, config.cell_m, spans);
  const double s = config.specular && !reading.is_light ? specular_p(config, reading, grid, spans) : 0.0;
  const Weights weights = weights_of(config);
  for_each_cell(config, reading, spans, [&](Cell cell, const BeamPlace& place, double alpha) {
    const double lambda0 = reading.is_echo ? config.lambda_of_echo(alpha, place.range_m, reading.range_m)
                                           : config.lambda_of_silence(alpha, place.range_m, reading.range_m);
    const double increment = kLogOddsPerNat * std::log((1.0 - s) * lambda0 + s);
    if (std::lround(increment) == 0) return;
    double weight = 1.0;
    if (config.log != LogPolicy::off) {
      const int bucket = bucket_of(reading.beam.T_map_sensor.theta_rad + place.bearing_rad, config.log_bearings);
      const int count = log.count(cell, bucket);
      weight = weights[static_cast<std::size_t>(count)];
      if (weight > 0.0) log.set_count(cell, bucket, count + 1);
    }
    const int change = static_cast<int>(std::lround(weight * increment));
    if (change != 0 && grid.add_log_odds(cell, change)) changed.push_back({cell.y, cell.x, cell.x + 1});
  });
}

const CellChanges& PlainMuriel::integrate(const Observation& observation, const PoseEstimate& pose) {
  changes_.spans.clear();
  if (!is_finite(pose.T_map_robot)) return changes_;
  for (const RangeReading& reading : observation.ranges)
    if (const auto evidence = placed(config_, reading, pose.T_map_robot))
      integrate_plainly(config_, *evidence, grid_, log_, spans_, changes_.spans);
  sonar_model::tidy(changes_.spans);
  return changes_;
}

}  // namespace cairn::muriel
