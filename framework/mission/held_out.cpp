#include "framework/mission/held_out.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "maps/grid/beam_cells.hpp"

namespace cairn {
namespace {

constexpr double kAnswer = 0.7;         // of a cell on a cone's axis
constexpr double kRayAnswer = 0.98;     // of a cell on a ray
constexpr double kOtherPerM = 0.05;     // answers of anything that the map does not hold
constexpr double kAnythingRatio = 0.1;  // readings that the map cannot explain
constexpr double kBelieved = 0.5;       // a cell answers when it is likelier occupied than not

double answer_of(const BeamPlace& place, double half_beam_rad) {
  if (half_beam_rad <= 0.0) return kRayAnswer;
  const double off_axis = place.bearing_rad / half_beam_rad;
  return kAnswer * (1.0 - off_axis * off_axis);
}

// The best answer of each ring.
std::vector<double> answers_of(const OccupancyGrid& grid, const Pose2& T_map_sensor, const RangeReading& reading) {
  const double cell_m = grid.cell_m();
  std::vector<double> answers(static_cast<std::size_t>(std::ceil(reading.max_m / cell_m)), 0.0);
  // Beams are given in the frame of the lattice.
  const Point p_lattice = T_map_sensor.position() - grid.origin_m();
  const Beam beam{{p_lattice.x(), p_lattice.y(), T_map_sensor.theta_rad}, reading.half_beam_rad, reading.max_m};
  const BeamFrame frame(beam, cell_m);
  std::vector<CellSpan> spans;
  spans_over(beam, cell_m, spans);
  for (const CellSpan& span : spans)
    for (int x = span.x_begin; x < span.x_end; ++x) {
      const double p = probability_of(grid.log_odds({x, span.y}));
      if (p <= kBelieved) continue;
      const BeamPlace place = frame.place_of({x, span.y});
      if (!place.is_inside) continue;
      const std::size_t ring = std::min(static_cast<std::size_t>(place.range_m / cell_m), answers.size() - 1);
      answers[ring] = std::max(answers[ring], answer_of(place, reading.half_beam_rad) * p);
    }
  return answers;
}

double normal_density(double off_m, double deviation_m) {
  const double z = off_m / deviation_m;
  return std::exp(-0.5 * z * z) / (deviation_m * std::sqrt(2.0 * std::numbers::pi));
}

}  // namespace

double log_likelihood(const OccupancyGrid& grid, const Pose2& T_map_sensor, const RangeReading& reading) {
  const std::vector<double> answers = answers_of(grid, T_map_sensor, reading);
  const double nothing_else = std::exp(-kOtherPerM * grid.cell_m());
  double silent = 1.0;  // chance that no ring so far has answered
  double density_per_m = 0.0;
  for (std::size_t ring = 0; ring < answers.size(); ++ring) {
    const double range_m = (static_cast<double>(ring) + 0.5) * grid.cell_m();
    const double answers_here = 1.0 - (1.0 - answers[ring]) * nothing_else;
    density_per_m += silent * answers_here * normal_density(reading.range_m - range_m, 0.01 + 0.015 * range_m);
    silent *= 1.0 - answers_here;
  }
  if (reading.range_m >= reading.max_m) return std::log((1.0 - kAnythingRatio) * silent + kAnythingRatio / 2.0);
  return std::log((1.0 - kAnythingRatio) * density_per_m + kAnythingRatio / (2.0 * reading.max_m));
}

void HeldOutReadings::on(const Event& event, const MissionView& view) {
  if (!std::holds_alternative<TickDone>(event) || view.world.observation == nullptr) return;
  for (const RangeReading& reading : view.world.observation->ranges) {
    if (!hold_out_.next()) continue;
    const bool measures = std::isfinite(reading.max_m) && reading.max_m > 0.0 && reading.half_beam_rad >= 0.0;
    if (!measures || !(reading.range_m >= reading.min_m)) continue;
    readings_.push_back({view.world.pose.T_map_robot * reading.T_robot_sensor, reading});
  }
}

double HeldOutReadings::mean_log_likelihood(const OccupancyGrid& grid) const {
  double sum = 0.0;
  for (const HeldOut& held_out : readings_) sum += log_likelihood(grid, held_out.T_map_sensor, held_out.reading);
  return readings_.empty() ? 0.0 : sum / static_cast<double>(readings_.size());
}

}  // namespace cairn
