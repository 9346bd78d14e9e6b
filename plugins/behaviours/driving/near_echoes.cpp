#include "plugins/behaviours/driving/near_echoes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cairn::behaviours {
namespace {

constexpr double kNearEcho_m = 1.0;
constexpr int kHit = 100;
constexpr int kSolid = 160;  // two hits
constexpr int kPassed = -50;
constexpr int kSurelyFree = -280;  // six echoes from behind it
constexpr LogOdds kStoodThere = -400;
constexpr double kMax_nat = 1.6;  // four hits
constexpr double kMovedOn_m = 0.02;
constexpr double kTurned_rad = radians(3.0);
constexpr int kBeamRays = 5;  // over the middle half of the beam

bool has_moved(const Pose2& a, const Pose2& b) {
  return (a.position() - b.position()).norm() >= kMovedOn_m ||
         std::abs(wrap_angle(a.theta_rad - b.theta_rad)) >= kTurned_rad;
}

bool is_usable(const RangeReading& reading) {
  return reading.range_m > reading.min_m && reading.range_m > 0.0 && reading.range_m <= kNearEcho_m &&
         reading.half_beam_rad >= 0.0 && reading.half_beam_rad <= std::numbers::pi && reading.sensor >= 0 &&
         reading.sensor < kMaxSensors;
}

}  // namespace

NearEchoes::NearEchoes(const OccupancyGrid& map) : votes_(map.cell_m(), kMax_nat, map.origin_m()) {}

void NearEchoes::see(const Observation& observation, const Pose2& T_map_robot) {
  for (const RangeReading& reading : observation.ranges) {
    const Pose2 T_map_sensor = T_map_robot * reading.T_robot_sensor;
    if (!is_usable(reading) || !votes_.can_include(T_map_sensor.position(), kNearEcho_m)) continue;
    const auto sensor = static_cast<std::size_t>(reading.sensor);
    const Pose2 nowhere{std::numeric_limits<double>::max(), 0.0, 0.0};
    if (sensor >= last_voted_.size()) last_voted_.resize(sensor + 1, nowhere);
    if (!has_moved(T_map_sensor, last_voted_[sensor])) continue;
    last_voted_[sensor] = T_map_sensor;
    vote(reading, T_map_sensor);
  }
}

void NearEchoes::vote(const RangeReading& reading, const Pose2& T_map_sensor) {
  const double cell_m = votes_.cell_m();
  std::vector<Cell> hit;
  std::vector<Cell> passed;
  for (int i = 0; i < kBeamRays; ++i) {
    const double bearing_rad = 0.5 * reading.half_beam_rad * (2.0 * i / (kBeamRays - 1) - 1.0);
    const Point direction{std::cos(bearing_rad), std::sin(bearing_rad)};
    hit.push_back(votes_.cell_at(T_map_sensor * (direction * reading.range_m)));
    for (double r_m = 0.0; r_m < reading.range_m - 2.0 * cell_m; r_m += 0.5 * cell_m)
      passed.push_back(votes_.cell_at(T_map_sensor * (direction * r_m)));
  }
  const auto once_each = [](std::vector<Cell>& cells) {
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  };
  once_each(hit);
  once_each(passed);
  for (const Cell c : hit) votes_.add_log_odds(c, kHit);
  for (const Cell c : passed)
    if (!std::binary_search(hit.begin(), hit.end(), c)) votes_.add_log_odds(c, kPassed);
}

void NearEchoes::stand_at(const Point& p_map, double radius_m) {
  if (!votes_.can_include(p_map, radius_m + votes_.cell_m())) return;
  const Cell centre = votes_.cell_at(p_map);
  const double max_cells = radius_m / votes_.cell_m() + 0.5;
  const int reach = static_cast<int>(max_cells);
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (dx * dx + dy * dy <= max_cells * max_cells) votes_.set_log_odds(centre + Cell{dx, dy}, kStoodThere);
}

bool NearEchoes::is_solid(Cell cell) const {
  return votes_.log_odds(cell) >= kSolid;
}

bool NearEchoes::is_conservatively_free(Cell cell) const {
  return votes_.log_odds(cell) <= kSurelyFree;
}

OccupancyGrid NearEchoes::applied_to(const OccupancyGrid& map, const CellBox& part) const {
  OccupancyGrid all(map.cell_m(), map.clamp_nat(), map.origin_m());
  const LogOdds solid = log_odds_of(0.9);
  const LogOdds free = log_odds_of(0.1);
  const CellBox box = intersected(part, united(map.bounds(), votes_.bounds()));
  const auto width = static_cast<std::size_t>(std::max(0, box.width()));
  std::vector<LogOdds> mapped(width);
  std::vector<LogOdds> voted(width);
  for (int y = box.min.y; y < box.max.y; ++y) {
    map.copy_log_odds({{box.min.x, y}, {box.max.x, y + 1}}, mapped);
    votes_.copy_log_odds({{box.min.x, y}, {box.max.x, y + 1}}, voted);
    for (std::size_t i = 0; i < width; ++i) {
      LogOdds value = mapped[i];
      if (voted[i] >= kSolid) value = std::max(value, solid);
      if (voted[i] <= kSurelyFree) value = std::min(value, free);
      if (value != 0) all.set_log_odds({box.min.x + static_cast<int>(i), y}, value);
    }
  }
  return all;
}

}  // namespace cairn::behaviours
