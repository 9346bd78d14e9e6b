#include "framework/host/stop_layer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr int kArcPoints = 5;  // a 30 degree arc at 0.5 m: a point each 6.5 cm

std::vector<Point> arc_of(const RangeReading& reading, const Pose2& T_odom_robot) {
  const Pose2 T_odom_sensor = T_odom_robot * reading.T_robot_sensor;
  std::vector<Point> points;
  const int count = reading.half_beam_rad > 0.0 ? kArcPoints : 1;
  for (int i = 0; i < count; ++i) {
    const double bearing = count == 1 ? 0.0 : reading.half_beam_rad * (2.0 * i / (count - 1) - 1.0);
    points.push_back(T_odom_sensor * Point(reading.range_m * std::cos(bearing), reading.range_m * std::sin(bearing)));
  }
  return points;
}

}  // namespace

void StopLayerConfig::describe(Fields<StopLayerConfig>& fields) {
  fields.number("margin_m", &StopLayerConfig::margin_m, {0.0, 1.0}, "m",
                "kept between the footprint and anything seen");
  fields.number("stale_s", &StopLayerConfig::stale_s, {0.05, 10.0}, "s", "an echo older than this no longer counts");
  fields.number("blind_s", &StopLayerConfig::blind_s, {0.05, 10.0}, "s", "no driving after so long without a reading");
}

StopLayer::StopLayer(const StopLayerConfig& config, const RobotModel& robot) : config_(config), robot_(robot) {}

void StopLayer::see(const Observation& observation) {
  T_odom_robot_ = observation.T_odom_robot;
  stamp_s_ = observation.stamp_s;
  for (const RangeReading& reading : observation.ranges) {
    if (reading.sensor < 0 || std::isnan(reading.range_m)) continue;
    last_reading_s_ = stamp_s_;
    if (static_cast<std::size_t>(reading.sensor) >= echoes_.size())
      echoes_.resize(static_cast<std::size_t>(reading.sensor) + 1);
    Echo& echo = echoes_[static_cast<std::size_t>(reading.sensor)];
    echo.stamp_s = stamp_s_;
    RangeReading seen = reading;
    // Nearer than the sensor can measure: take it to be at that nearest range.
    if (seen.range_m < seen.min_m) seen.range_m = seen.min_m;
    echo.points_odom = std::isfinite(seen.range_m) ? arc_of(seen, T_odom_robot_) : std::vector<Point>{};
  }
}

// Straight way ahead (or behind) before the footprint, grown by the margin, meets an echo.
double StopLayer::free_way_m(const Twist& wanted) const {
  const double reach = robot_.radius_m + config_.margin_m;
  const Pose2 T_robot_odom = inverse(T_odom_robot_);
  const double sign = wanted.v_mps < 0.0 ? -1.0 : 1.0;
  double way = std::numeric_limits<double>::infinity();
  for (const Echo& echo : echoes_) {
    if (echo.stamp_s < 0.0 || stamp_s_ - echo.stamp_s > config_.stale_s) continue;
    for (const Point& p_odom : echo.points_odom) {
      const Point p = T_robot_odom * p_odom;
      const double ahead = sign * p.x();
      if (ahead <= 0.0 || std::abs(p.y()) >= reach) continue;
      way = std::min(way, ahead - std::sqrt(reach * reach - p.y() * p.y()));
    }
  }
  return way;
}

Twist StopLayer::limit(const Twist& wanted) const {
  Twist allowed;
  if (!std::isfinite(wanted.v_mps) || !std::isfinite(wanted.w_radps)) return allowed;
  allowed.v_mps = std::clamp(wanted.v_mps, -robot_.max_v_mps, robot_.max_v_mps);
  allowed.w_radps = std::clamp(wanted.w_radps, -robot_.max_w_radps, robot_.max_w_radps);
  if (stamp_s_ - last_reading_s_ > config_.blind_s) return Twist{};
  if (allowed.v_mps == 0.0) return allowed;
  const double way = std::max(0.0, free_way_m(allowed));
  const double fastest = std::sqrt(2.0 * robot_.max_acceleration_mps2 * way);
  // Slowing down keeps the curve: turn rate falls with the speed, except when only turning is left.
  if (fastest < std::abs(allowed.v_mps)) {
    if (fastest > 0.0) allowed.w_radps *= fastest / std::abs(allowed.v_mps);
    allowed.v_mps = std::copysign(fastest, allowed.v_mps);
  }
  return allowed;
}

double StopLayer::held_back_ratio(const Twist& wanted, const Twist& allowed) const {
  if (wanted.v_mps == 0.0) return 0.0;
  return 1.0 - std::min(1.0, std::abs(allowed.v_mps) / std::min(std::abs(wanted.v_mps), robot_.max_v_mps));
}

}  // namespace cairn
