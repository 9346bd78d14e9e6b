#include "plugins/behaviours/local_map/local_obstacles.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::behaviours {
namespace {

constexpr double kApart_m = 0.02;  // points of a scan that lie closer together are one

}  // namespace

void LocalObstacleSettings::describe(Fields<LocalObstacleSettings>& fields) {
  using C = LocalObstacleSettings;
  fields.number("within_m", &C::within_m, {0.1, 20.0}, "m", "what is further away does not count");
  fields.number("map_every_s", &C::map_every_s, {0.0, 10.0}, "s", "occupied cells are read from the map this often");
  fields.number("echo_counts_s", &C::echo_counts_s, {0.0, 60.0}, "s",
                "the last echo of a transducer counts for so long; about a round of the sonars");
  fields.number("behind_m", &C::behind_m, {0.0, 5.0}, "m",
                "an echo from this far behind a place says that nothing is there");
  fields.number("explained_m", &C::explained_m, {0.0, 5.0}, "m",
                "an occupied cell at an echo's range, give or take this, explains the echo");
  fields.number("sure_beam_ratio", &C::sure_beam_ratio, {0.0, 1.0}, "",
                "share of a beam's width within which an echo says something about a place");
  fields.angle("min_beam_deg", &C::min_beam_rad, {0.0, 90.0}, "but at least this to each side");
  fields.integer("arc_points", &C::arc_points, {2.0, 100.0}, "points on the arc that an echo may have come from");
}

void LocalObstacles::gather_cells(const WorldView& world, const NearEchoes& near_echoes, const CellSet& ignored) {
  gathered_s_ = world.time_s;
  cells_map_.clear();
  const OccupancyGrid& grid = world.grid;
  const Cell centre = grid.cell_at(world.pose.T_map_robot.position());
  const int reach = static_cast<int>(std::ceil(settings_.within_m / grid.cell_m()));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      if (dx * dx + dy * dy > reach * reach) continue;
      const Cell c = centre + Cell{dx, dy};
      if (near_echoes.is_occupied(grid, c) && !ignored.contains(c)) cells_map_.push_back(grid.centre_of(c));
    }
  }
}

void LocalObstacles::add(const RangeReading& reading, const WorldView& world) {
  if (reading.sensor < 0 || reading.sensor >= kMaxSensors || std::isnan(reading.range_m)) return;
  const auto index = static_cast<std::size_t>(reading.sensor);
  if (index >= echoes_.size()) echoes_.resize(index + 1);
  Echo& echo = echoes_[index];
  const double range_m = std::max(reading.range_m, reading.min_m);
  const Pose2 T_map_sensor = world.pose.T_map_robot * reading.T_robot_sensor;
  echo = {world.time_s, range_m, reading.half_beam_rad, T_map_sensor, {}};
  if (range_m > settings_.within_m) return;
  for (int i = 0; i < settings_.arc_points; ++i) {
    const double bearing_rad = reading.half_beam_rad * (2.0 * i / (settings_.arc_points - 1) - 1.0);
    echo.points_map.push_back(T_map_sensor * Point(range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad)));
  }
}

void LocalObstacles::add_scan(std::span<const RangeReading> rays, const WorldView& world) {
  const Pose2& T_map_robot = world.pose.T_map_robot;
  Scan scan{rays.front().sensor, world.time_s, T_map_robot * rays.front().T_robot_sensor.position(), {}, {}};
  std::vector<BearingMaxima::Entry> ranges;
  for (const RangeReading& ray : rays) {
    const double range_m = std::max(ray.range_m, ray.min_m);
    if (!std::isfinite(range_m)) continue;
    const double bearing_rad = wrap_angle(T_map_robot.theta_rad + ray.T_robot_sensor.theta_rad);
    ranges.push_back({bearing_rad, range_m});
    if (range_m > settings_.within_m) continue;
    const Point at_map = scan.from_map + range_m * Point(std::cos(bearing_rad), std::sin(bearing_rad));
    const bool is_new = scan.points_map.empty() || (scan.points_map.back() - at_map).norm() >= kApart_m;
    if (is_new) scan.points_map.push_back(at_map);
  }
  scan.ranges_m = BearingMaxima(std::move(ranges));
  const auto known = std::ranges::find(scans_, scan.first_sensor, &Scan::first_sensor);
  if (known == scans_.end())
    scans_.push_back(std::move(scan));
  else
    *known = std::move(scan);
}

// An echo from behind a place says that nothing is there now; silence does not, for a mirror is silent too.
LocalObstacles::Live LocalObstacles::live_echo_at(const Point& p_map, double time_s) const {
  Live live = Live::silent;
  for (const Echo& echo : echoes_) {
    if (time_s - echo.stamp_s > settings_.echo_counts_s || !std::isfinite(echo.range_m)) continue;
    const Point to = p_map - echo.T_map_sensor.position();
    const double behind_m = echo.range_m - to.norm();
    const double off_rad = wrap_angle(std::atan2(to.y(), to.x()) - echo.T_map_sensor.theta_rad);
    const double beam_rad = std::max(settings_.min_beam_rad, settings_.sure_beam_ratio * echo.half_beam_rad);
    if (std::abs(off_rad) > beam_rad || behind_m < -settings_.behind_m) continue;
    if (behind_m >= settings_.behind_m) return Live::seen_through;
    live = Live::there;
  }
  for (const Scan& scan : scans_) {
    const Point to = p_map - scan.from_map;
    const double behind_m = scan.ranges_m.max_within(std::atan2(to.y(), to.x()), settings_.min_beam_rad) - to.norm();
    if (behind_m >= settings_.behind_m) return Live::seen_through;
    if (behind_m >= -settings_.behind_m) live = Live::there;
  }
  return live;
}

// By something known in its beam at its range: then the echo came from there, and not from all of its arc. With all of
// the arcs that its posts echo on, a narrow door would be closed.
bool LocalObstacles::is_explained(const Echo& echo, const std::vector<Point>& there_map) const {
  return std::ranges::any_of(there_map, [&](const Point& p) {
    const Point to = p - echo.T_map_sensor.position();
    const double off_rad = wrap_angle(std::atan2(to.y(), to.x()) - echo.T_map_sensor.theta_rad);
    return std::abs(to.norm() - echo.range_m) <= settings_.explained_m && std::abs(off_rad) <= echo.half_beam_rad;
  });
}

void LocalObstacles::see(const WorldView& world, const NearEchoes& near_echoes, const CellSet& ignored) {
  if (world.time_s - gathered_s_ >= settings_.map_every_s) gather_cells(world, near_echoes, ignored);
  if (world.observation != nullptr)
    for_each_scan(
        world.observation->ranges, [&](const RangeReading& cone) { add(cone, world); },
        [&](std::span<const RangeReading> rays) { add_scan(rays, world); });
  std::erase_if(scans_, [&](const Scan& scan) { return world.time_s - scan.stamp_s > settings_.echo_counts_s; });
  std::vector<Point> there_map;
  for (const Point& p : cells_map_)
    if (live_echo_at(p, world.time_s) != Live::seen_through) there_map.push_back(p);
  points_.clear();
  const Pose2 T_robot_map = inverse(world.pose.T_map_robot);
  for (const Point& p : there_map) points_.push_back(T_robot_map * p);
  for (const Echo& echo : echoes_) {
    if (world.time_s - echo.stamp_s > settings_.echo_counts_s || echo.points_map.empty() ||
        is_explained(echo, there_map))
      continue;
    for (const Point& p : echo.points_map) points_.push_back(T_robot_map * p);
  }
  for (const Scan& scan : scans_)
    for (const Point& p : scan.points_map) points_.push_back(T_robot_map * p);
}

}  // namespace cairn::behaviours
