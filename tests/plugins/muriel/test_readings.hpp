// Readings and settings at random, for the tests of the MURIEL map.
#pragma once

#include <limits>
#include <random>

#include "framework/contracts/mapper.hpp"
#include "plugins/muriel/config.hpp"

namespace cairn::muriel {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline RangeReading sonar(double range_m, const Pose2& T_robot_sensor = {}) {
  return {T_robot_sensor, radians(15.0), 0.1, 5.0, range_m, 0};
}

inline Observation observed(std::vector<RangeReading> ranges) {
  Observation observation;
  observation.ranges = std::move(ranges);
  return observation;
}

inline PoseEstimate at(const Pose2& T_map_robot) {
  return {T_map_robot, {}};
}

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int below(int end) { return static_cast<int>(random_() % static_cast<std::uint64_t>(end)); }
  std::uint64_t word() { return random_(); }

  Config config() {
    Config config;
    config.cell_m = below(4) == 0 ? 0.1 : 0.05;
    config.clamp_nat = between(1.0, 20.0);
    config.alpha_max = between(0.3, 0.95);
    config.alpha_range_m = between(2.0, 6.0);
    config.delta_m = between(0.005, 0.03);
    config.delta_per_m = between(0.0, 0.03);
    config.false_echo_per_m = between(0.4, 3.0);
    config.specular = below(3) != 0;
    config.specular_prior = between(0.05, 0.8);
    config.specular_per_m = between(0.1, 2.0);
    config.specular_sectors = 1 + below(12);
    config.believed_p = between(0.5, 0.9);
    config.log = static_cast<LogPolicy>(below(3));
    // In whole planes of the log, as usual, or any number.
    config.log_bearings = below(2) == 0 ? 8 * (1 + below(4)) : 4 + below(29);
    config.log_readings = 1 + below(3);
    config.log_fall = between(0.2, 1.0);
    return config;
  }
  RangeReading reading() {
    RangeReading reading =
        sonar(below(4) == 0 ? kInfinity : between(0.1, 4.9), {0.13, between(-0.1, 0.1), between(-3.0, 3.0)});
    constexpr double kHalfBeams_deg[] = {15.0, 15.0, 15.0, 7.5, 25.0, 44.0, 60.0, 0.1, 0.0};
    reading.half_beam_rad = radians(kHalfBeams_deg[below(9)]);
    if (below(5) == 0) reading.max_m = 2.0;  // near enough for the bend of the no-echo model to count
    return reading;
  }
  Pose2 pose() { return {between(-2.0, 2.0), between(-2.0, 2.0), between(-3.1, 3.1)}; }

 private:
  std::mt19937_64 random_;
};

}  // namespace cairn::muriel
