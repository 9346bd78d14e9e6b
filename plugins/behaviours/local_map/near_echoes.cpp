#include "plugins/behaviours/local_map/near_echoes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cairn::behaviours {
namespace {

// In order. Rays from one place fill most of the box about them: marking cells there takes less than sorting them.
void once_each(std::vector<Cell>& cells) {
  constexpr std::size_t kSortedUpTo = 64;
  constexpr std::size_t kMaxBoxCells = 8;  // for each of them
  CellBox box;
  if (cells.size() > kSortedUpTo) {
    box = {cells.front(), cells.front()};
    for (const Cell c : cells) {
      box.min = {std::min(box.min.x, c.x), std::min(box.min.y, c.y)};
      box.max = {std::max(box.max.x, c.x + 1), std::max(box.max.y, c.y + 1)};
    }
  }
  const std::size_t height = static_cast<std::size_t>(box.max.y) - static_cast<std::size_t>(box.min.y);
  const double box_cells = static_cast<double>(height) * (static_cast<double>(box.max.x) - box.min.x);
  if (box_cells <= 0.0 || box_cells > static_cast<double>(kMaxBoxCells * cells.size())) {
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return;
  }
  std::vector<char> is_in(static_cast<std::size_t>(box_cells), 0);
  for (const Cell c : cells)
    is_in[static_cast<std::size_t>(c.x - box.min.x) * height + static_cast<std::size_t>(c.y - box.min.y)] = 1;
  cells.clear();
  std::size_t i = 0;
  for (int x = box.min.x; x < box.max.x; ++x)
    for (int y = box.min.y; y < box.max.y; ++y)
      if (is_in[i++] != 0) cells.push_back({x, y});
}

}  // namespace

void NearEchoSettings::describe(Fields<NearEchoSettings>& fields) {
  using C = NearEchoSettings;
  const Range weight{-32000.0, 32000.0};
  fields.number("within_m", &C::within_m, {0.05, 20.0}, "m", "echoes from further away do not count");
  fields.number("moved_m", &C::moved_m, {0.0, 5.0}, "m", "a transducer counts again when it has moved this far");
  fields.angle("turned_deg", &C::turned_rad, {0.0, 180.0}, "or turned this far");
  fields.integer("rays", &C::rays, {2.0, 101.0}, "lines in the middle half of a beam along which an echo counts");
  fields.integer("hit", &C::hit, weight, "evidence of an echo for the cells it came from, in 1/256 nat");
  fields.integer("passed", &C::passed, weight, "evidence of an echo for the cells it passed, in 1/256 nat");
  fields.integer("solid_at", &C::solid_at, weight, "a cell is solid from this evidence on: two echoes");
  fields.integer("free_at", &C::free_at, weight, "a cell is free at this evidence: six echoes from behind it");
  fields.integer("stood", &C::stood, weight, "evidence of cells that the robot has stood on");
  fields.number("clamp_nat", &C::clamp_nat, {0.1, 100.0}, "nat", "evidence of a cell is kept within this: four echoes");
}

NearEchoes::NearEchoes(const OccupancyGrid& map, const NearEchoSettings& settings)
    : settings_(settings), votes_(map.cell_m(), settings.clamp_nat, map.origin_m()) {}

bool NearEchoes::has_moved(const Pose2& a, const Pose2& b) const {
  return (a.position() - b.position()).norm() >= settings_.moved_m ||
         std::abs(wrap_angle(a.theta_rad - b.theta_rad)) >= settings_.turned_rad;
}

bool NearEchoes::is_usable(const RangeReading& reading) const {
  return reading.range_m > reading.min_m && reading.range_m > 0.0 && reading.range_m <= settings_.within_m &&
         reading.half_beam_rad >= 0.0 && reading.half_beam_rad <= std::numbers::pi && reading.sensor >= 0 &&
         reading.sensor < kMaxSensors;
}

bool NearEchoes::counts_anew(const RangeReading& reading, const Pose2& T_map_sensor) {
  const auto sensor = static_cast<std::size_t>(reading.sensor);
  const Pose2 nowhere{std::numeric_limits<double>::max(), 0.0, 0.0};
  if (sensor >= last_voted_.size()) last_voted_.resize(sensor + 1, nowhere);
  if (!has_moved(T_map_sensor, last_voted_[sensor])) return false;
  last_voted_[sensor] = T_map_sensor;
  return true;
}

void NearEchoes::see(const Observation& observation, const Pose2& T_map_robot) {
  const auto see_cone = [&](const RangeReading& reading) {
    const Pose2 T_map_sensor = T_map_robot * reading.T_robot_sensor;
    if (!is_usable(reading) || !votes_.can_include(T_map_sensor.position(), settings_.within_m)) return;
    if (counts_anew(reading, T_map_sensor)) vote(reading, T_map_sensor);
  };
  for_each_scan(observation.ranges, see_cone, [&](std::span<const RangeReading> rays) { vote(rays, T_map_robot); });
}

bool NearEchoes::is_far_echo(const RangeReading& reading, double to_m) const {
  return reading.range_m > std::max(settings_.within_m, to_m) && reading.range_m < reading.max_m &&
         reading.sensor >= 0 && reading.sensor < kMaxSensors && reading.half_beam_rad >= 0.0 &&
         reading.half_beam_rad <= std::numbers::pi;
}

void NearEchoes::see_through(const Observation& observation, const Pose2& T_map_robot, double to_m) {
  const auto see_cone = [&](const RangeReading& reading) {
    const Pose2 T_map_sensor = T_map_robot * reading.T_robot_sensor;
    if (!is_far_echo(reading, to_m) || !votes_.can_include(T_map_sensor.position(), to_m)) return;
    if (!counts_anew(reading, T_map_sensor)) return;
    for (const Cell c : passed_by(reading, T_map_sensor, to_m)) votes_.add_log_odds(c, settings_.passed);
  };
  for_each_scan(observation.ranges, see_cone,
                [&](std::span<const RangeReading> rays) { vote_through(rays, T_map_robot, to_m); });
}

void NearEchoes::vote(std::span<const RangeReading> rays, const Pose2& T_map_robot) {
  std::vector<RangeReading> near;
  for (const RangeReading& ray : rays)
    if (is_usable(ray) && is_finite(ray.T_robot_sensor)) near.push_back(ray);
  if (near.empty()) return;
  const Pose2 T_map_sensor = T_map_robot * near.front().T_robot_sensor;
  if (!votes_.can_include(T_map_sensor.position(), settings_.within_m)) return;
  if (!counts_anew(near.front(), T_map_sensor)) return;
  std::vector<Cell> hit;
  hit.reserve(near.size());
  for (const RangeReading& ray : near)
    hit.push_back(votes_.cell_at(T_map_robot * (ray.T_robot_sensor * Point(ray.range_m, 0.0))));
  std::vector<Cell> passed;
  pass(near, T_map_robot, std::numeric_limits<double>::infinity(), 2.0 * votes_.cell_m(), passed);
  once_each(hit);
  for (const Cell c : hit) votes_.add_log_odds(c, settings_.hit);
  for (const Cell c : passed)
    if (!std::binary_search(hit.begin(), hit.end(), c)) votes_.add_log_odds(c, settings_.passed);
}

void NearEchoes::vote_through(std::span<const RangeReading> rays, const Pose2& T_map_robot, double to_m) {
  std::vector<RangeReading> far;
  for (const RangeReading& ray : rays)
    if (is_far_echo(ray, to_m) && is_finite(ray.T_robot_sensor)) far.push_back(ray);
  if (far.empty()) return;
  const Pose2 T_map_sensor = T_map_robot * far.front().T_robot_sensor;
  if (!votes_.can_include(T_map_sensor.position(), to_m) || !counts_anew(far.front(), T_map_sensor)) return;
  std::vector<Cell> passed;
  pass(far, T_map_robot, to_m, 0.0, passed);
  for (const Cell c : passed) votes_.add_log_odds(c, settings_.passed);
}

void NearEchoes::pass(std::span<const RangeReading> rays, const Pose2& T_map_robot, double longest_m, double short_of_m,
                      std::vector<Cell>& cells) const {
  const double cell_m = votes_.cell_m();
  const double together_rad = 0.5 * cell_m / settings_.within_m;
  for (std::size_t first = 0; first < rays.size();) {
    std::size_t shortest = first;
    std::size_t end = first + 1;
    for (; end < rays.size(); ++end) {
      const double apart_rad = wrap_angle(rays[end].T_robot_sensor.theta_rad - rays[first].T_robot_sensor.theta_rad);
      if (std::abs(apart_rad) > together_rad) break;
      if (rays[end].range_m < rays[shortest].range_m) shortest = end;
    }
    const Pose2 T_map_sensor = T_map_robot * rays[shortest].T_robot_sensor;
    const Point step = 0.5 * cell_m * T_map_sensor.direction();
    const double to_m = std::min(longest_m, rays[shortest].range_m - short_of_m);
    const int steps = static_cast<int>(std::ceil(to_m / (0.5 * cell_m)));
    for (int i = 0; i < steps; ++i) cells.push_back(votes_.cell_at(T_map_sensor.position() + i * step));
    first = end;
  }
  once_each(cells);
}

std::vector<Cell> NearEchoes::passed_by(const RangeReading& reading, const Pose2& T_map_sensor, double to_m) const {
  const double cell_m = votes_.cell_m();
  std::vector<Cell> passed;
  for (int i = 0; i < settings_.rays; ++i) {
    const double bearing_rad = 0.5 * reading.half_beam_rad * (2.0 * i / (settings_.rays - 1) - 1.0);
    const Point direction{std::cos(bearing_rad), std::sin(bearing_rad)};
    for (double r_m = 0.0; r_m < to_m; r_m += 0.5 * cell_m)
      passed.push_back(votes_.cell_at(T_map_sensor * (direction * r_m)));
  }
  once_each(passed);
  return passed;
}

void NearEchoes::vote(const RangeReading& reading, const Pose2& T_map_sensor) {
  const double cell_m = votes_.cell_m();
  std::vector<Cell> hit;
  const std::vector<Cell> passed = passed_by(reading, T_map_sensor, reading.range_m - 2.0 * cell_m);
  for (int i = 0; i < settings_.rays; ++i) {
    const double bearing_rad = 0.5 * reading.half_beam_rad * (2.0 * i / (settings_.rays - 1) - 1.0);
    const Point direction{std::cos(bearing_rad), std::sin(bearing_rad)};
    hit.push_back(votes_.cell_at(T_map_sensor * (direction * reading.range_m)));
  }
  once_each(hit);
  for (const Cell c : hit) votes_.add_log_odds(c, settings_.hit);
  for (const Cell c : passed)
    if (!std::binary_search(hit.begin(), hit.end(), c)) votes_.add_log_odds(c, settings_.passed);
}

void NearEchoes::stand_at(const Point& p_map, double radius_m) {
  if (!votes_.can_include(p_map, radius_m + votes_.cell_m())) return;
  const Cell centre = votes_.cell_at(p_map);
  const double max_cells = radius_m / votes_.cell_m() + 0.5;
  const int reach = static_cast<int>(max_cells);
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (dx * dx + dy * dy <= max_cells * max_cells)
        votes_.set_log_odds(centre + Cell{dx, dy}, static_cast<LogOdds>(settings_.stood));
}

bool NearEchoes::is_solid(Cell cell) const {
  return votes_.log_odds(cell) >= settings_.solid_at;
}

bool NearEchoes::is_conservatively_free(Cell cell) const {
  return votes_.log_odds(cell) <= settings_.free_at;
}

OccupancyGrid NearEchoes::applied_to(const OccupancyGrid& map, const CellBox& part) const {
  OccupancyGrid all(map.cell_m(), map.clamp_nat(), map.origin_m());
  const LogOdds solid = log_odds_of(1.0 - kFree);
  const LogOdds free = log_odds_of(kFree);
  const CellBox box = intersected(part, united(map.bounds(), votes_.bounds()));
  const auto width = static_cast<std::size_t>(std::max(0, box.width()));
  std::vector<LogOdds> mapped(width);
  std::vector<LogOdds> voted(width);
  for (int y = box.min.y; y < box.max.y; ++y) {
    map.copy_log_odds({{box.min.x, y}, {box.max.x, y + 1}}, mapped);
    votes_.copy_log_odds({{box.min.x, y}, {box.max.x, y + 1}}, voted);
    for (std::size_t i = 0; i < width; ++i) {
      LogOdds value = mapped[i];
      if (voted[i] >= settings_.solid_at) value = std::max(value, solid);
      if (voted[i] <= settings_.free_at) value = std::min(value, free);
      if (value != 0) all.set_log_odds({box.min.x + static_cast<int>(i), y}, value);
    }
  }
  return all;
}

}  // namespace cairn::behaviours
