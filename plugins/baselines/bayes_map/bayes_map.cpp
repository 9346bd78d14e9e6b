#include "plugins/baselines/bayes_map/bayes_map.hpp"

#include <algorithm>
#include <cmath>

#include "maps/grid/beam_cells.hpp"
#include "plugins/common/sonar_model/reading.hpp"

namespace cairn::bayes_map {

using sonar_model::Meaning;

BayesMap::BayesMap(const Config& config) : beam_model_(config), grid_(config.cell_m, config.clamp_nat) {}

const CellChanges& BayesMap::integrate(const Observation& observation, const PoseEstimate& pose) {
  changes_.spans.clear();
  if (!is_finite(pose.T_map_robot)) return changes_;
  for (const RangeReading& reading : observation.ranges) integrate_reading(reading, pose.T_map_robot);
  const std::size_t beams = changes_.spans.size();
  cleared_footprint_.take(grid_, pose.T_map_robot, changes_.spans);
  const bool is_one_beam = observation.ranges.size() <= 1 && changes_.spans.size() == beams;
  if (!is_one_beam) sonar_model::tidy(changes_.spans);
  return changes_;
}

void BayesMap::integrate_reading(const RangeReading& reading, const Pose2& T_map_robot) {
  const Meaning meaning = sonar_model::meaning_of(reading);
  if (meaning == Meaning::ignored) return;
  const bool echo = meaning == Meaning::echo;
  const Beam beam{T_map_robot * reading.T_robot_sensor, reading.half_beam_rad,
                  echo ? beam_model_.reach_of_echo_m(reading.range_m) : beam_model_.reach_of_silence_m(reading.max_m)};
  if (!grid_.can_include(beam.T_map_sensor.position(), beam.reach_m)) return;
  const BeamFrame frame(beam, grid_.cell_m());

  const auto increment_of = [&](const BeamPlace& place) {
    const double alpha = beam_model_.alpha(place.range_m, place.bearing_rad, beam.half_beam_rad);
    const double lambda = echo ? beam_model_.lambda_of_echo(alpha, place.range_m, reading.range_m)
                               : beam_model_.lambda_of_silence(alpha, place.range_m, reading.max_m);
    return static_cast<int>(std::lround(kLogOddsPerNat * std::log(lambda)));
  };
  spans_over(beam, grid_.cell_m(), spans_);
  for (const CellSpan& span : spans_) {
    CellSpan moved{span.y, span.x_end, span.x_end};
    for (int x = span.x_begin; x < span.x_end; ++x) {
      const Cell cell{x, span.y};
      const BeamPlace place = frame.place_of(cell);
      const int increment = place.is_inside ? increment_of(place) : 0;
      if (increment == 0 || !grid_.add_log_odds(cell, increment)) continue;  // 0 must not grow the grid
      moved.x_begin = std::min(moved.x_begin, x);
      moved.x_end = x + 1;
    }
    if (moved.x_begin < moved.x_end) changes_.spans.push_back(moved);
  }
}

}  // namespace cairn::bayes_map
