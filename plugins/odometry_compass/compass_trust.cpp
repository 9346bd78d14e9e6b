#include "plugins/odometry_compass/compass_trust.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::odometry_compass {
namespace {

constexpr double kStatementWeight = 25.0;  // readings that the file's statement counts for
constexpr double kSettledReadings = 100.0;
constexpr double kMaxReadings = 1000.0;  // older ones are forgotten
constexpr double kCutOffSquare = 9.0;    // of a difference, over its variance

double deviations_of_mean(double mean, double share) {
  return std::abs(mean) / std::sqrt(share / (2.0 - share));
}

}  // namespace

CompassNoise::CompassNoise(double stated_rad)
    : stated_rad_(stated_rad), mean_square_(2.0 * stated_rad * stated_rad), readings_(kStatementWeight) {}

void CompassNoise::add(double turned_more_rad) {
  const double square = std::min(turned_more_rad * turned_more_rad, kCutOffSquare * mean_square_);
  readings_ = std::min(readings_ + 1.0, kMaxReadings);
  mean_square_ += (square - mean_square_) / readings_;
}

double CompassNoise::deviation_rad() const {
  return std::max(stated_rad_, std::sqrt(0.5 * mean_square_));
}

bool CompassNoise::is_settled() const {
  return readings_ >= kSettledReadings;
}

void CompassDrift::add(double off_sigmas) {
  fast_ += kFastShare * (off_sigmas - fast_);
  slow_ += kSlowShare * (off_sigmas - slow_);
}

void CompassDrift::restart() {
  fast_ = 0.0;
  slow_ = 0.0;
}

bool CompassDrift::is_fast(double sigmas) const {
  return deviations_of_mean(fast_, kFastShare) > sigmas;
}

bool CompassDrift::is_slow(double sigmas) const {
  return deviations_of_mean(slow_, kSlowShare) > sigmas;
}

}  // namespace cairn::odometry_compass
