#include "framework/safety/ray_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/safety/range_buffer.hpp"

namespace cairn {
namespace {

constexpr double kCell_m = 0.05;
constexpr double kPassedBehind_m = 0.1;  // farther away than that is behind
constexpr double kBesideRay_rad = radians(1.0);
constexpr double kSamePlace_rad = radians(1.5);  // in which something of the scan before stood still
constexpr double kComparedAfter_s = 0.19;        // less, and noise hides who walks

bool is_ray(const RangeReading& reading) {
  return reading.half_beam_rad <= 0.0;
}

// Of two angles in [-pi, pi].
double sum_of(double a_rad, double b_rad) {
  const double sum_rad = a_rad + b_rad;
  if (std::abs(sum_rad) <= std::numbers::pi) return sum_rad;
  return sum_rad > 0.0 ? sum_rad - 2.0 * std::numbers::pi : sum_rad + 2.0 * std::numbers::pi;
}

double bearing_of(const Point& p) {
  return std::atan2(p.y(), p.x());
}

std::uint64_t cell_of(const Point& p) {
  const auto x = static_cast<std::int32_t>(std::floor(std::clamp(p.x() / kCell_m, -1e9, 1e9)));
  const auto y = static_cast<std::int32_t>(std::floor(std::clamp(p.y() / kCell_m, -1e9, 1e9)));
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32U | static_cast<std::uint32_t>(y);
}

}  // namespace

RayBuffer::RayBuffer(const RobotModel& robot, double kept_s, double kept_m, double other_period_s)
    : kept_s_(kept_s), kept_m_(kept_m) {
  for (std::size_t i = 0; i < robot.lasers.size(); ++i) {
    scanners_.emplace_back();
    scanners_.back().first_sensor = first_beam_of(robot, i);
    scanners_.back().period_s = 1.0 / robot.lasers[i].rate_hz;
  }
  scanners_.emplace_back();
  scanners_.back().first_sensor = std::numeric_limits<int>::max();
  scanners_.back().period_s = other_period_s;
}

void RayBuffer::forget() {
  directions_ = {};
  for (Scanner& scanner : scanners_) {
    scanner.stamp_s = -1e9;
    scanner.last.clear();
    scanner.compared = scanner.to_compare = {};
    scanner.before.clear();
  }
}

RayBuffer::Scanner& RayBuffer::scanner_of(int sensor) {
  Scanner* found = &scanners_.back();
  for (Scanner& scanner : scanners_)
    if (scanner.first_sensor <= sensor) found = &scanner;
  return *found;
}

void RayBuffer::see(const Observation& observation) {
  stamp_s_ = observation.stamp_s;
  const std::span<const RangeReading> all(observation.ranges);
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first + 1;
    const auto is_same_scan = [&](const RangeReading& reading) {
      return is_ray(reading) && reading.T_robot_sensor.position() == all[first].T_robot_sensor.position() &&
             &scanner_of(reading.sensor) == &scanner_of(all[first].sensor);
    };
    while (is_ray(all[first]) && end < all.size() && is_same_scan(all[end])) ++end;
    if (is_ray(all[first])) take(all.subspan(first, end - first), observation);
    first = end;
  }
  for (Scanner& scanner : scanners_) {
    const auto is_old = [&](const Kept& kept) { return stamp_s_ - kept.stamp_s > kept_s_; };
    std::erase_if(scanner.last, is_old);
    std::erase_if(scanner.before, [&](const auto& entry) { return is_old(entry.second); });
  }
}

void RayBuffer::take(std::span<const RangeReading> rays, const Observation& observation) {
  Scanner& scanner = scanner_of(rays.front().sensor);
  const Pose2& T_odom_robot = observation.T_odom_robot;
  const Point from_odom = T_odom_robot * rays.front().T_robot_sensor.position();
  if (stamp_s_ - scanner.to_compare.stamp_s >= kComparedAfter_s) std::swap(scanner.compared, scanner.to_compare);
  const double passed_s = stamp_s_ - scanner.compared.stamp_s;
  const bool is_recent = passed_s > 0.0 && passed_s <= 2.5 * std::max(scanner.period_s, kComparedAfter_s);
  const BearingMaxima expected = is_recent ? expected_from(scanner.compared, from_odom) : BearingMaxima();
  const double heading_rad = wrap_angle(T_odom_robot.theta_rad);
  std::vector<BearingMaxima::Entry> ranges;
  std::vector<Kept> seen;
  for (const RangeReading& ray : rays) {
    if (!says_something(ray)) continue;
    const double range_m = std::max(ray.range_m, ray.min_m);
    const double bearing_rad = sum_of(heading_rad, ray.T_robot_sensor.theta_rad);
    const bool is_echo = std::isfinite(range_m);
    directions_.look(ray.T_robot_sensor.theta_rad, stamp_s_);
    if (is_echo) ranges.push_back({bearing_rad, range_m});
    if (!is_echo || range_m > kept_m_) continue;
    const double still_m = -expected.max_within(bearing_rad, kSamePlace_rad);
    const double closing_mps = std::isfinite(still_m) ? closing_speed_mps(still_m, range_m, passed_s) : 0.0;
    seen.push_back({from_odom + range_m * Point(std::cos(bearing_rad), std::sin(bearing_rad)), closing_mps, stamp_s_});
  }
  clear_before(scanner, from_odom, BearingMaxima(std::move(ranges)));
  // Another part of the same scan, from another place: both are the last.
  if (scanner.stamp_s == stamp_s_) {
    scanner.last.insert(scanner.last.end(), seen.begin(), seen.end());
    return;
  }
  if (stamp_s_ - scanner.to_compare.stamp_s >= kComparedAfter_s) {
    scanner.to_compare = {stamp_s_, {}};
    for (const Kept& kept : seen) scanner.to_compare.points_odom.push_back(kept.at_odom);
  }
  keep_last(scanner);
  scanner.last = std::move(seen);
  scanner.stamp_s = stamp_s_;
}

BearingMaxima RayBuffer::expected_from(const Compared& compared, const Point& from_odom) {
  std::vector<BearingMaxima::Entry> nearer;
  nearer.reserve(compared.points_odom.size());
  for (const Point& p : compared.points_odom) nearer.push_back({bearing_of(p - from_odom), -(p - from_odom).norm()});
  return BearingMaxima(std::move(nearer));
}

void RayBuffer::clear_before(Scanner& scanner, const Point& from_odom, const BearingMaxima& ranges_m) const {
  const auto is_seen_through = [&](const Kept& kept) {
    if (kept.stamp_s == stamp_s_) return false;
    const Point p = kept.at_odom - from_odom;
    return p.norm() < ranges_m.max_within(bearing_of(p), kBesideRay_rad) - kPassedBehind_m;
  };
  std::erase_if(scanner.last, is_seen_through);
  std::erase_if(scanner.before, [&](const auto& entry) { return is_seen_through(entry.second); });
}

// What approached may have come nearer since: of a scan that is not the last only the place counts.
void RayBuffer::keep_last(Scanner& scanner) const {
  for (Kept& kept : scanner.last) {
    kept.closing_mps = 0.0;
    scanner.before[cell_of(kept.at_odom)] = kept;
  }
}

void RayBuffer::append_points(const Pose2& T_robot_odom, std::vector<SeenPoint>& points) const {
  for (const Scanner& scanner : scanners_) {
    const double until_s = std::max(0.0, scanner.stamp_s + scanner.period_s - stamp_s_);
    for (const Kept& kept : scanner.last) points.push_back({T_robot_odom * kept.at_odom, kept.closing_mps, until_s});
    for (const auto& [cell, kept] : scanner.before) points.push_back({T_robot_odom * kept.at_odom, 0.0, until_s});
  }
}

bool RayBuffer::covers(double direction_rad) const {
  return directions_.have_looked(direction_rad, stamp_s_ - kept_s_);
}

}  // namespace cairn
