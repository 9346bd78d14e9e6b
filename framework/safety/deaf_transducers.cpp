#include "framework/safety/deaf_transducers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/safety/range_buffer.hpp"

namespace cairn {
namespace {

constexpr double kRound_s = 0.2;         // answers that come sooner after each other are one round
constexpr double kGroupSilent_s = 0.25;  // at least, before a ring is taken to be deaf
// Of the whole ring, its left and its right half: a smooth wall at a slant may be heard by nobody of a half for long.
constexpr std::array<double, 3> kUncertainWeights{0.5, 0.25, 0.25};
constexpr double kBesideMiddle = 0.05;  // sine of what looks straight ahead or back, and belongs to no half
constexpr double kNeighbour_rad = radians(60.5);
constexpr double kBumpedSide_rad = radians(60.5);
// To both sides of the motion: what a footprint sweeps before it can stand. A transducer at 30 degrees that is deaf
// between good ones costs nothing; one whose whole side is deaf does.
constexpr double kSwept_rad = radians(35.0);
constexpr double kStep_rad = radians(5.0);
constexpr double kBesideDeafBeam_rad = radians(10.0);  // beyond its beam a transducer hears what is near, as well

double between(double a_rad, double b_rad) {
  return std::abs(wrap_angle(a_rad - b_rad));
}

}  // namespace

bool is_no_echo(const RangeReading& reading) {
  return reading.range_m > 0.0 && (std::isinf(reading.range_m) || reading.range_m >= reading.max_m);
}

void DeafTransducers::forget() {
  for (Transducer& transducer : transducers_) {
    transducer.counted_s = transducer.stamp_s = transducer.echo_s = -1e9;
    transducer.silent_rounds = transducer.missed_rounds = 0;
  }
  groups_ = {};
  ray_directions_ = {};
  has_place_ = false;
  changes_.clear();
}

void DeafTransducers::see(const Observation& observation, std::span<const ExpectedEcho> expected) {
  changes_.clear();
  stamp_s_ = observation.stamp_s;
  const Point at_odom = observation.T_odom_robot.position();
  if (has_place_) silent_path_m_ += (at_odom - at_odom_).norm();
  has_place_ = true;
  at_odom_ = at_odom;
  for (const RangeReading& reading : observation.ranges) {
    if (!says_something(reading)) continue;
    if (reading.half_beam_rad <= 0.0) {
      take_ray(reading);
      continue;
    }
    Transducer& transducer = transducer_of(reading);
    const auto echo = std::ranges::find_if(expected, [&](const ExpectedEcho& one) {
      return one.sensor == reading.sensor && one.range_m <= config_.within_m;
    });
    if (is_no_echo(reading))
      take_silence(transducer, echo == expected.end() ? nullptr : &*echo);
    else
      take_echo(transducer);
  }
  judge();
  spread();
}

void DeafTransducers::take_ray(const RangeReading& ray) {
  if (!is_no_echo(ray)) silent_path_m_ = 0.0;
  ray_directions_.look(ray.T_robot_sensor.theta_rad, stamp_s_);
}

DeafTransducers::Transducer& DeafTransducers::transducer_of(const RangeReading& reading) {
  auto found = std::ranges::find(transducers_, reading.sensor, &Transducer::sensor);
  if (found == transducers_.end()) found = transducers_.insert(found, Transducer{.sensor = reading.sensor});
  found->axis_rad = reading.T_robot_sensor.theta_rad;
  found->half_beam_rad = reading.half_beam_rad;
  found->stamp_s = stamp_s_;
  return *found;
}

void DeafTransducers::take_echo(Transducer& transducer) {
  transducer.is_silent = false;
  transducer.echo_s = stamp_s_;
  transducer.silent_rounds = transducer.missed_rounds = 0;
  for (std::size_t i = 0; i < kGroups; ++i)
    if (is_in(i, transducer)) groups_[i] = {0.0, stamp_s_};
  silent_path_m_ = 0.0;
  set_deaf(transducer, false, DeafCause::missed_echo);
}

bool DeafTransducers::is_in(std::size_t group, const Transducer& transducer) {
  const double left = std::sin(transducer.axis_rad);
  return group == 0 || (group == 1 ? left > kBesideMiddle : left < -kBesideMiddle);
}

void DeafTransducers::take_silence(Transducer& transducer, const ExpectedEcho* expected) {
  transducer.is_silent = true;
  for (std::size_t i = 0; i < kGroups && expected != nullptr; ++i)
    if (is_in(i, transducer)) groups_[i].missed += expected->is_certain ? 1.0 : kUncertainWeights[i];
  if (stamp_s_ - transducer.counted_s < kRound_s) return;
  transducer.counted_s = stamp_s_;
  ++transducer.silent_rounds;
  if (expected != nullptr && expected->is_certain) ++transducer.missed_rounds;
}

void DeafTransducers::judge() {
  std::array<bool, kGroups> are_deaf{};
  for (std::size_t i = 0; i < kGroups; ++i)
    are_deaf[i] = groups_[i].missed >= config_.ring_echoes && stamp_s_ - groups_[i].last_echo_s >= kGroupSilent_s;
  for (Transducer& transducer : transducers_) {
    if (transducer.missed_rounds >= config_.rounds) set_deaf(transducer, true, DeafCause::missed_echo);
    for (std::size_t i = 0; i < kGroups; ++i)
      if (are_deaf[i] && transducer.is_silent && is_in(i, transducer))
        set_deaf(transducer, true, DeafCause::silent_ring);
  }
}

// Halves of a ring fail together, and not every transducer of them looks at a wall. Who has answered since did not fail
// with that one.
void DeafTransducers::spread() {
  for (bool has_spread = !deaf_.empty(); has_spread;) {
    has_spread = false;
    for (Transducer& transducer : transducers_) {
      if (transducer.is_deaf || transducer.silent_rounds < config_.rounds) continue;
      const bool has_deaf_neighbour = std::ranges::any_of(transducers_, [&](const Transducer& other) {
        return other.is_deaf && transducer.echo_s <= other.deaf_s &&
               between(other.axis_rad, transducer.axis_rad) <= kNeighbour_rad;
      });
      if (!has_deaf_neighbour) continue;
      set_deaf(transducer, true, DeafCause::deaf_neighbour);
      has_spread = true;
    }
  }
}

void DeafTransducers::feel_bump(double side_rad) {
  for (Transducer& transducer : transducers_)
    if (transducer.is_silent && between(transducer.axis_rad, side_rad) <= kBumpedSide_rad)
      set_deaf(transducer, true, DeafCause::bump);
}

void DeafTransducers::set_deaf(Transducer& transducer, bool is_deaf, DeafCause cause) {
  if (transducer.is_deaf == is_deaf) return;
  transducer.is_deaf = is_deaf;
  if (is_deaf) transducer.deaf_s = stamp_s_;
  changes_.push_back({transducer.sensor, is_deaf, cause});
  const auto at = std::ranges::lower_bound(deaf_, transducer.sensor);
  if (is_deaf)
    deaf_.insert(at, transducer.sensor);
  else
    deaf_.erase(at);
}

bool DeafTransducers::is_towards(double direction_rad) const {
  if (deaf_.empty()) return false;
  const auto someone_looks = [&](double at_rad, bool deaf, double beside_rad) {
    return std::ranges::any_of(transducers_, [&](const Transducer& transducer) {
      return transducer.is_deaf == deaf && (deaf || stamp_s_ - transducer.stamp_s <= kept_s_) &&
             between(transducer.axis_rad, at_rad) <= transducer.half_beam_rad + beside_rad;
    });
  };
  for (double off_rad = -kSwept_rad; off_rad <= kSwept_rad + 0.5 * kStep_rad; off_rad += kStep_rad) {
    const double at_rad = direction_rad + off_rad;
    if (someone_looks(at_rad, true, 0.0) && !someone_looks(at_rad, false, kBesideDeafBeam_rad) &&
        !ray_directions_.have_looked(at_rad, stamp_s_ - kept_s_))
      return true;
  }
  return false;
}

}  // namespace cairn
