#include "plugins/odometry_compass/odometry_compass.hpp"

#include <algorithm>
#include <utility>

namespace cairn::odometry_compass {
namespace {

// One tracker's walls must speak so much louder than the other's to be believed. A wall that is met just where it is
// expected counts 6; trackers that are both right differ by some 5 %.
constexpr double kLouder = 1.15;
constexpr double kClearly = 12.0;
constexpr int kMaxWins = 5;  // that count

CompassBias stated_bias(const Config& config, const RobotModel& robot) {
  const double bound_rad = robot.compass_error.local_bias_rad;
  return {config.local_bias_ratio * bound_rad, bound_rad};
}

bool is_louder(const PoseTracker& one, const PoseTracker& other, double clearly) {
  return one.wall_evidence() > kLouder * other.wall_evidence() + clearly;
}

}  // namespace

OdometryCompass::OdometryCompass(const Config& config, const RobotModel& robot, const Pose2& T_map_start,
                                 std::span<const LandmarkShape> shapes, const StartUncertainty& start)
    : use_landmarks_(config.use_landmarks),
      chosen_bias_(stated_bias(config, robot)),
      other_bias_{config.unstated_bias_rad, CompassBias::kFar * config.unstated_bias_rad},
      chosen_(config, robot, chosen_bias_, T_map_start, start),
      landmark_sightings_({shapes.begin(), shapes.end()}) {
  const bool may_be_biased = config.use_compass && robot.has_compass && config.use_walls &&
                             chosen_bias_.deviation_rad == 0.0 && other_bias_.deviation_rad > 0.0;
  if (may_be_biased) other_.emplace(config, robot, other_bias_, T_map_start, start);
}

PoseEstimate OdometryCompass::update(const Observation& observation, const KnownMap& known) {
  std::span<const LandmarkSighting> sightings;
  // Of the first observation nothing says where the odometry begins.
  if (use_landmarks_ && chosen_.T_odom_robot())
    sightings = landmark_sightings_.look(observation, chosen_.estimate(), *chosen_.T_odom_robot(), known);
  const PoseEstimate estimate = update_by(observation, sightings);
  return use_landmarks_ ? follow_markers(observation, known, estimate) : estimate;
}

PoseEstimate OdometryCompass::follow_markers(const Observation& observation, const KnownMap& known,
                                             const PoseEstimate& before) {
  const std::span<const LandmarkSighting> sightings = marker_sightings_.look(observation, before, known);
  if (sightings.empty()) return before;
  PoseEstimate estimate = chosen_.correct(sightings);
  estimate.sightings_used += before.sightings_used;
  estimate.sightings_refused += before.sightings_refused;
  return estimate;
}

PoseEstimate OdometryCompass::update_by(const Observation& observation, std::span<const LandmarkSighting> sightings) {
  PoseEstimate estimate = chosen_.update(observation, sightings);
  if (!other_) return estimate;
  // Landmarks stand where the chosen one has drawn them: they are no witness.
  (void)other_->update(observation, {});
  if (chosen_.starts_biased() || is_louder(*other_, chosen_, kClearly * (1 + wins_))) {
    std::swap(chosen_, *other_);
    std::swap(chosen_bias_, other_bias_);
    wins_ = 0;
    begin_again();
    const int refused = estimate.sightings_used + estimate.sightings_refused;
    estimate = chosen_.estimate();
    estimate.sightings_refused = refused;
  } else if (is_louder(chosen_, *other_, kClearly)) {
    wins_ = std::min(wins_ + 1, kMaxWins);
    begin_again();
  }
  return estimate;
}

// The other one, from where the chosen one is.
void OdometryCompass::begin_again() {
  chosen_.restart_wall_evidence();
  other_ = chosen_;
  other_->believe(other_bias_);
}

}  // namespace cairn::odometry_compass
