#include "framework/mission/hearing/expected_echoes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn {
namespace {

constexpr std::size_t kRays = 7;
constexpr double kNotFree_cells = 2.5;  // before a wall, where the map blurs it
constexpr double kFlat_cells = 1.5;     // off the line through them all

// Where the ray meets what is occupied, sensor frame; none: nowhere, or there is unknown space before it.
std::optional<Point> hit_of(const OccupancyGrid& grid, const OccupancyThresholds& thresholds, const Pose2& T_map_sensor,
                            double bearing_rad, double reach_m) {
  const Point ahead(std::cos(bearing_rad), std::sin(bearing_rad));
  const double step_m = 0.5 * grid.cell_m();
  std::optional<double> not_free_m;  // since there
  for (double range_m = grid.cell_m(); range_m <= reach_m; range_m += step_m) {
    const CellState state = grid.state(grid.cell_at(T_map_sensor * Point(range_m * ahead)), thresholds);
    if (state == CellState::occupied) return range_m * ahead;
    if (state == CellState::free)
      not_free_m.reset();
    else if (range_m - *(not_free_m = not_free_m.value_or(range_m)) > kNotFree_cells * grid.cell_m())
      return std::nullopt;
  }
  return std::nullopt;
}

bool is_sure(const PoseEstimate& pose, const DeafConfig& config) {
  const double position_m = std::sqrt(std::max({pose.covariance(0, 0), pose.covariance(1, 1), 0.0}));
  const double heading_rad = std::sqrt(std::max(pose.covariance(2, 2), 0.0));
  return position_m <= config.max_pose_m && heading_rad <= config.max_heading_rad;
}

using Hits = std::array<std::optional<Point>, kRays>;

// Whether all of them lie on a line nearly perpendicular to the axis, which is x:  x = m + s (y - n).
bool is_wall_across(const Hits& hits, double cell_m, double max_incidence_rad) {
  Point middle(0.0, 0.0);
  for (const std::optional<Point>& hit : hits) {
    if (!hit) return false;
    middle += *hit / static_cast<double>(kRays);
  }
  double xy = 0.0;
  double yy = 1e-9;
  for (const std::optional<Point>& hit : hits) {
    xy += (*hit - middle).x() * (*hit - middle).y();
    yy += (*hit - middle).y() * (*hit - middle).y();
  }
  const double slope = xy / yy;
  if (std::abs(std::atan(slope)) > max_incidence_rad) return false;
  return std::ranges::all_of(hits, [&](const std::optional<Point>& hit) {
    return std::abs((*hit - middle).x() - slope * (*hit - middle).y()) <= kFlat_cells * cell_m;
  });
}

}  // namespace

std::optional<ExpectedEcho> expected_echo(const OccupancyGrid& grid, const Pose2& T_map_sensor, double half_beam_rad,
                                          const DeafConfig& config, int sensor) {
  const OccupancyThresholds thresholds = OccupancyThresholds::of(0.35, config.occupied_p);
  const double reach_m = config.within_m / std::cos(std::min(half_beam_rad, radians(30.0)));
  Hits hits;
  double nearest_m = reach_m;
  for (std::size_t i = 0; i < kRays; ++i) {
    const double bearing_rad = half_beam_rad * (2.0 * static_cast<double>(i) / (kRays - 1) - 1.0);
    hits[i] = hit_of(grid, thresholds, T_map_sensor, bearing_rad, reach_m);
    if (hits[i]) nearest_m = std::min(nearest_m, hits[i]->norm());
  }
  const bool is_in_the_middle = hits[kRays / 2 - 1] && hits[kRays / 2] && hits[kRays / 2 + 1];
  if (!is_in_the_middle || nearest_m > config.within_m) return std::nullopt;
  return ExpectedEcho{sensor, nearest_m, is_wall_across(hits, grid.cell_m(), config.max_incidence_rad)};
}

std::vector<ExpectedEcho> expected_echoes(const Observation& observation, const OccupancyGrid& grid,
                                          const PoseEstimate& pose, const DeafConfig& config) {
  std::vector<ExpectedEcho> expected;
  if (!is_sure(pose, config)) return expected;
  for (const RangeReading& reading : observation.ranges) {
    if (!is_no_echo(reading) || reading.half_beam_rad <= 0.0 || !is_finite(reading.T_robot_sensor)) continue;
    const Pose2 T_map_sensor = pose.T_map_robot * reading.T_robot_sensor;
    if (const auto echo = expected_echo(grid, T_map_sensor, reading.half_beam_rad, config, reading.sensor))
      expected.push_back(*echo);
  }
  return expected;
}

}  // namespace cairn
