#include "plugins/baselines/murphy_map/murphy_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maps/grid/beam_cells.hpp"
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

const CellChanges& MurphyMap::integrate(const Observation& observation, const PoseEstimate& pose) {
  changes_.spans.clear();
  if (!is_finite(pose.T_map_robot)) return changes_;
  for (const RangeReading& reading : observation.ranges) integrate_reading(reading, pose.T_map_robot);
  const std::size_t beams = changes_.spans.size();
  cleared_footprint_.take(grid_, pose.T_map_robot, changes_.spans);
  const bool is_one_beam = observation.ranges.size() <= 1 && changes_.spans.size() == beams;
  if (!is_one_beam) sonar_model::tidy(changes_.spans);
  return changes_;
}

void MurphyMap::integrate_reading(const RangeReading& reading, const Pose2& T_map_robot) {
  const Meaning meaning = sonar_model::meaning_of(reading);
  if (meaning == Meaning::ignored) return;
  const double range_m = std::min(reading.max_m, config_.range_m);
  const double echo_m = meaning == Meaning::echo ? reading.range_m : std::numeric_limits<double>::infinity();
  const Beam beam{T_map_robot * reading.T_robot_sensor, reading.half_beam_rad,
                  std::min(range_m, echo_m + config_.tolerance_m)};
  if (!grid_.can_include(beam.T_map_sensor.position(), beam.reach_m)) return;
  const BeamFrame frame(beam, grid_.cell_m());
  const auto increment_at = [&](Cell cell) {
    const BeamPlace place = frame.place_of(cell);
    if (!place.is_inside) return 0;
    const double p = occupied_p(config_, place.range_m, place.bearing_rad, beam.half_beam_rad, echo_m, range_m);
    const double nat = std::clamp(std::log(p / (1.0 - p)), -100.0, 100.0);  // belief may be 0 or 1
    return static_cast<int>(std::lround(kLogOddsPerNat * nat));
  };
  spans_over(beam, grid_.cell_m(), spans_);
  for (const CellSpan& span : spans_) {
    CellSpan moved{span.y, span.x_end, span.x_end};
    for (int x = span.x_begin; x < span.x_end; ++x) {
      const int increment = increment_at({x, span.y});
      if (increment == 0 || !grid_.add_log_odds({x, span.y}, increment)) continue;  // 0 must not grow the grid
      moved.x_begin = std::min(moved.x_begin, x);
      moved.x_end = x + 1;
    }
    if (moved.x_begin < moved.x_end) changes_.spans.push_back(moved);
  }
}

}  // namespace cairn::murphy_map
