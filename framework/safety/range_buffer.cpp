#include "framework/safety/range_buffer.hpp"

#include <algorithm>
#include <cmath>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

constexpr int kArcPoints = 7;          // a 30 degree arc at 0.5 m: a point each 4.4 cm
constexpr std::size_t kMaxEchoes = 4;  // of one transducer
constexpr double kTouchKept_s = 5.0;
// Of half a beam, in which another transducer would surely have heard it; the same one would have in all of it.
constexpr double kCertainBeamRatio = 0.6;
constexpr double kBehind_m = 0.1;  // farther away than that is behind
constexpr double kBesideBeam_rad = radians(10.0);
constexpr double kThin_rad = radians(1.0);  // half a beam of no width
// Differences of two ranges that noise explains, as a share of the range, and at least.
constexpr double kNoise_m = 0.03;
constexpr double kNoiseRatio = 0.015;

std::vector<Point> arc_of(const RangeReading& reading, const Pose2& T_odom_sensor) {
  std::vector<Point> points;
  for (int i = 0; i < kArcPoints; ++i) {
    const double bearing = reading.half_beam_rad * (2.0 * i / (kArcPoints - 1) - 1.0);
    points.push_back(T_odom_sensor * Point(reading.range_m * std::cos(bearing), reading.range_m * std::sin(bearing)));
  }
  return points;
}

double round_of(const RobotModel& robot) {
  const std::size_t shots = robot.firing_order.empty() ? robot.sonars.size() : robot.firing_order.size();
  return robot.firing_period_s * static_cast<double>(std::max<std::size_t>(1, shots));
}

}  // namespace

bool is_placed(const Observation& observation) {
  return std::isfinite(observation.stamp_s) && is_finite(observation.T_odom_robot);
}

bool says_something(const RangeReading& reading) {
  return reading.sensor >= 0 && reading.sensor < kMaxTransducers && !std::isnan(reading.range_m) &&
         is_finite(reading.T_robot_sensor) && std::isfinite(reading.half_beam_rad) && std::isfinite(reading.min_m);
}

double closing_speed_mps(double expected_m, double range_m, double passed_s) {
  const double nearer_m = expected_m - range_m;
  if (nearer_m < kNoise_m + kNoiseRatio * range_m) return 0.0;
  const double speed_mps = nearer_m / passed_s;
  return speed_mps > kFastestMover_mps ? 0.0 : speed_mps;  // faster: something else has come into the beam
}

RangeBuffer::RangeBuffer(const RobotModel& robot, double kept_s, double rays_within_m)
    : kept_s_(std::max({kept_s, 1.5 * round_of(robot), 1.5 * reading_period_s(robot)})),
      round_s_(round_of(robot)),
      rays_(robot, kept_s_, rays_within_m, round_s_) {}

void RangeBuffer::forget() {
  transducers_.clear();
  rays_.forget();
  touches_.clear();
  points_.clear();
}

void RangeBuffer::see(const Observation& observation) {
  T_odom_robot_ = observation.T_odom_robot;
  stamp_s_ = observation.stamp_s;
  for (const RangeReading& reading : observation.ranges)
    if (reading.half_beam_rad > 0.0 && says_something(reading)) take(reading);
  rays_.see(observation);
  for (Transducer& transducer : transducers_)
    std::erase_if(transducer.echoes, [&](const Echo& echo) { return stamp_s_ - echo.stamp_s > kept_s_; });
  std::erase_if(touches_, [&](const Touch& touch) { return stamp_s_ - touch.stamp_s > kTouchKept_s; });
  show();
}

void RangeBuffer::take(const RangeReading& reading) {
  const auto index = static_cast<std::size_t>(reading.sensor);
  if (index >= transducers_.size()) transducers_.resize(index + 1);
  Transducer& transducer = transducers_[index];
  RangeReading seen = reading;
  // Nearer than the sensor can measure: take it to be at that nearest range.
  if (seen.range_m < seen.min_m) seen.range_m = seen.min_m;
  Echo echo{stamp_s_, closing_mps(transducer, seen), {}};
  transducer.stamp_s = stamp_s_;
  transducer.axis_rad = reading.T_robot_sensor.theta_rad;
  transducer.half_beam_rad = reading.half_beam_rad;
  if (!std::isfinite(seen.range_m)) return;
  clear_before(seen);
  echo.points_odom = arc_of(seen, T_odom_robot_ * seen.T_robot_sensor);
  if (transducer.echoes.size() == kMaxEchoes) transducer.echoes.erase(transducer.echoes.begin());
  transducer.echoes.push_back(std::move(echo));
}

// Against the nearest that the last echo could be from here if it stood still.
double RangeBuffer::closing_mps(const Transducer& transducer, const RangeReading& reading) const {
  if (transducer.echoes.empty() || transducer.echoes.back().points_odom.empty() || !std::isfinite(reading.range_m))
    return 0.0;
  const Echo& last = transducer.echoes.back();
  const double passed_s = stamp_s_ - last.stamp_s;
  if (passed_s <= 0.0) return 0.0;
  const Point from = (T_odom_robot_ * reading.T_robot_sensor).position();
  double expected_m = std::numeric_limits<double>::infinity();
  for (const Point& p : last.points_odom) expected_m = std::min(expected_m, (p - from).norm());
  return closing_speed_mps(expected_m, reading.range_m, passed_s);
}

void RangeBuffer::clear_before(const RangeReading& reading) {
  const Pose2 T_sensor_odom = inverse(T_odom_robot_ * reading.T_robot_sensor);
  const double nearer_m = reading.range_m - kBehind_m;
  for (Transducer& transducer : transducers_) {
    const bool is_own = &transducer == &transducers_[static_cast<std::size_t>(reading.sensor)];
    const double half_rad = (is_own ? 1.0 : kCertainBeamRatio) * reading.half_beam_rad + kThin_rad;
    for (Echo& echo : transducer.echoes)
      std::erase_if(echo.points_odom, [&](const Point& p_odom) {
        const Point p = T_sensor_odom * p_odom;
        return p.norm() < nearer_m && std::abs(std::atan2(p.y(), p.x())) <= half_rad;
      });
  }
}

void RangeBuffer::feel(const Point& at_robot) {
  touches_.push_back({stamp_s_, T_odom_robot_ * at_robot});
  show();
}

void RangeBuffer::show() {
  points_.clear();
  const Pose2 T_robot_odom = inverse(T_odom_robot_);
  for (const Transducer& transducer : transducers_) {
    for (const Echo& echo : transducer.echoes) {
      const bool is_last = &echo == &transducer.echoes.back();
      const double until_s = std::max(0.0, transducer.stamp_s + round_s_ - stamp_s_);
      for (const Point& p : echo.points_odom)
        points_.push_back({T_robot_odom * p, is_last ? echo.closing_mps : 0.0, until_s});
    }
  }
  rays_.append_points(T_robot_odom, points_);
  for (const Touch& touch : touches_) points_.push_back({T_robot_odom * touch.at_odom, 0.0, 0.0});
}

bool RangeBuffer::covers(double direction_rad) const {
  if (rays_.covers(direction_rad)) return true;
  return std::any_of(transducers_.begin(), transducers_.end(), [&](const Transducer& transducer) {
    return stamp_s_ - transducer.stamp_s <= kept_s_ &&
           std::abs(wrap_angle(transducer.axis_rad - direction_rad)) <= transducer.half_beam_rad + kBesideBeam_rad;
  });
}

}  // namespace cairn
