#include "plugins/simulated_robot/instruments.hpp"

#include <cmath>
#include <numbers>

namespace cairn {
namespace {

enum Purpose : std::uint64_t { odometry_noise = 1, compass_noise, compass_bias };

constexpr int kWaves = 12;

}  // namespace

Odometer::Odometer(const OdometryError& error, double turn_as_distance_m_per_rad, std::uint64_t seed)
    : error_(error),
      turn_as_distance_m_per_rad_(turn_as_distance_m_per_rad),
      noise_(seed, odometry_noise),
      scale_(1.0 + error.distance_bias_ratio * noise_.normal()) {}

void Odometer::add(const Move& move) {
  const double distance_m = std::abs(move.distance_m);
  const double turn_m = turn_as_distance_m_per_rad_ * std::abs(move.turn_rad);
  const double seen_m = move.distance_m * scale_ + error_.distance_ratio * std::sqrt(distance_m) * noise_.normal();
  const double seen_rad = move.turn_rad + error_.heading_rad_per_m * std::sqrt(distance_m + turn_m) * noise_.normal();
  T_odom_robot_ = T_odom_robot_ * along_arc(seen_m, seen_rad);
}

Compass::Compass(const CompassError& error, std::uint64_t seed) : error_(error), noise_(seed, compass_noise) {
  NoiseStream field(seed, compass_bias);
  for (int i = 0; i < kWaves; ++i) {
    const double direction_rad = 2.0 * std::numbers::pi * field.uniform();
    const double wave_number_radpm = (0.5 + field.uniform()) / error.local_bias_scale_m;
    waves_.push_back({wave_number_radpm * Point(std::cos(direction_rad), std::sin(direction_rad)),
                      2.0 * std::numbers::pi * field.uniform()});
  }
}

double Compass::bias_rad(const Point& p_m) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += std::cos(wave.wave_number_radpm.dot(p_m) + wave.phase_rad);
  return error_.local_bias_rad * std::tanh(sum / std::sqrt(0.5 * kWaves));
}

double Compass::read(const Pose2& T_map_robot) {
  return wrap_angle(T_map_robot.theta_rad + bias_rad(T_map_robot.position()) + error_.noise_rad * noise_.normal());
}

}  // namespace cairn
