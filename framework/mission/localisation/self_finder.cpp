#include "framework/mission/localisation/self_finder.hpp"

#include <algorithm>
#include <cmath>

#include "framework/landmarks/marker_tracker.hpp"

namespace cairn {
namespace {

constexpr double kCompassSlack_rad = radians(15.0);  // what no robot's file knows: steel beside the way

constexpr double kMarkerAngle_rad = radians(4.0);  // standard deviation of a marker that counts
constexpr double kMarkersAgree_m = 0.3;
constexpr double kMarkersAgree_rad = radians(8.0);

}  // namespace

SelfFinder::SelfFinder(const OccupancyGrid& map, const RobotModel& robot)
    : search_(map),
      compass_within_rad_(kCompassSlack_rad + robot.compass_error.noise_rad + robot.compass_error.local_bias_rad),
      has_compass_(robot.has_compass) {}

void SelfFinder::update(const Observation& observation, const Pose2& T_local_robot, const OccupancyGrid& seen,
                        double time_s) {
  follow_compass(observation, T_local_robot);
  if (running_ && time_s >= running_->begun_s + kAnswerAfter_s) {
    belief_.update(running_->answer.get(), running_->T_local_robot);
    running_.reset();
    ++searches_;
    if (T_map_local()) return;
  }
  if (!belief_.drive(T_local_robot) || running_) return;
  running_ =
      Search{std::async(std::launch::async, [this, around = surroundings_of(seen, T_local_robot),
                                             turned = heading(T_local_robot)] { return search_.find(around, turned); }),
             T_local_robot, time_s};
}

void SelfFinder::see_markers(const Observation& observation, const Pose2& T_local_robot, const LandmarkGraph& known) {
  for (const MarkerSighting& sighting : observation.markers) {
    const auto is_same = [&](const MarkerSighting& other) { return other.marker == sighting.marker; };
    if (std::ranges::count_if(observation.markers, is_same) > 1) continue;  // no one marker
    const Landmark* const landmark = sighting.mirrored ? nullptr : known.find_marker(sighting.marker);
    if (landmark == nullptr || sighting.pose.covariance(2, 2) > kMarkerAngle_rad * kMarkerAngle_rad) continue;
    const Pose2 guess = landmark->T_map_landmark * inverse(T_local_robot * sighting.pose.T_robot_marker);
    if (marker_guess_ && marker_guess_->marker == sighting.marker &&
        !are_apart(marker_guess_->T_local_robot, T_local_robot))
      continue;
    if (marker_guess_) {
      const Pose2 off = inverse(marker_guess_->T_map_local * T_local_robot) * (guess * T_local_robot);
      if (off.position().norm() < kMarkersAgree_m && std::abs(off.theta_rad) < kMarkersAgree_rad) by_marker_ = guess;
    }
    marker_guess_ = MarkerGuess{sighting.marker, guess, T_local_robot};
  }
}

void SelfFinder::follow_compass(const Observation& observation, const Pose2& T_local_robot) {
  if (!has_compass_ || !observation.compass_rad || !std::isfinite(*observation.compass_rad)) return;
  compass_sum_ += unit_vector(*observation.compass_rad - T_local_robot.theta_rad);
}

std::optional<KnownHeading> SelfFinder::heading(const Pose2& T_local_robot) const {
  if (compass_sum_.norm() < 0.5) return std::nullopt;
  const double turned_rad = std::atan2(compass_sum_.y(), compass_sum_.x());
  return KnownHeading{wrap_angle(turned_rad + T_local_robot.theta_rad), compass_within_rad_};
}

LocalisationFigures SelfFinder::figures() const {
  LocalisationFigures figures;
  figures.driven_m = belief_.driven_m();
  figures.searches = searches_;
  figures.guesses = belief_.guesses();
  return figures;
}

}  // namespace cairn
