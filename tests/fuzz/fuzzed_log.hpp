// What every fuzzer of a log reader does: the bytes as a file, all lines read, the promises kept.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "plugins/log_common/scan_log.hpp"

namespace cairn::fuzz {

// A file in memory; one for the whole run.
inline std::filesystem::path file_of(const std::uint8_t* data, std::size_t size) {
  static const int file = memfd_create("fuzzed", 0);
  if (file < 0 || ftruncate(file, 0) != 0 || pwrite(file, data, size, 0) != static_cast<ssize_t>(size)) std::abort();
  return "/proc/self/fd/" + std::to_string(file);
}

inline bool keeps_contract(const RangeReading& r) {
  const Pose2& at = r.T_robot_sensor;
  const bool is_placed = std::isfinite(at.x_m) && std::isfinite(at.y_m) && std::isfinite(at.theta_rad);
  const bool has_limits = r.half_beam_rad >= 0.0 && r.min_m >= 0.0 && r.min_m < r.max_m && std::isfinite(r.max_m);
  return is_placed && has_limits && r.sensor >= 0 &&
         (!std::isfinite(r.range_m) || (r.range_m >= r.min_m && r.range_m <= r.max_m));
}

// Plays the log that read() gives; what it refuses by ConfigError is fine, anything else is a find.
template <class Read>
int play(Read read) {
  try {
    log_common::ScanPlayer player(read());
    double last_s = -std::numeric_limits<double>::infinity();
    while (true) {
      const SensorStep step = player.next({});
      if (step.state != SensorState::observation) return step.reason.empty() ? (std::abort(), 0) : 0;
      const Observation& seen = step.observation;
      const Pose2& odom = seen.T_odom_robot;
      if (!(seen.stamp_s >= last_s) || !std::isfinite(odom.x_m + odom.y_m + odom.theta_rad)) std::abort();
      last_s = seen.stamp_s;
      for (const RangeReading& reading : seen.ranges)
        if (!keeps_contract(reading)) std::abort();
    }
  } catch (const ConfigError&) {
    return 0;
  }
}

}  // namespace cairn::fuzz
