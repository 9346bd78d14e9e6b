#include "framework/mission/localisation/self_finder.hpp"

#include <algorithm>
#include <cmath>

#include "framework/landmarks/markers/marker_tracker.hpp"

namespace cairn {
namespace {

constexpr double kCompassSlack_rad = radians(15.0);  // what no robot's file knows: steel beside the way

constexpr double kMarkerAngle_rad = radians(4.0);  // standard deviation of a marker that counts
constexpr double kMarkersAgree_m = 0.3;
constexpr double kMarkersAgree_rad = radians(8.0);

constexpr double kSamePlace_m = 0.8;  // guesses are at least 1 m or 30 degrees apart
constexpr double kSamePlace_rad = radians(25.0);

bool is_same_place(const Pose2& a, const Pose2& b) {
  const Pose2 off = inverse(a) * b;
  return off.position().norm() < kSamePlace_m && std::abs(off.theta_rad) < kSamePlace_rad;
}

constexpr double kAnyHeading_rad = 2.0;  // standard deviation

}  // namespace

StartUncertainty own_frame(const RobotModel& robot) {
  return {0.0, robot.has_compass ? kAnyHeading_rad : 0.0};
}

double compass_within(const RobotModel& robot) {
  return kCompassSlack_rad + robot.compass_error.noise_rad + robot.compass_error.local_bias_rad;
}

SelfFinder::SelfFinder(std::shared_ptr<const OccupancyGrid> map, const RobotModel& robot)
    : searched_(std::make_shared<Searched>(Searched{std::move(map)})),
      compass_within_rad_(compass_within(robot)),
      has_compass_(robot.has_compass) {}

void SelfFinder::update(const Observation& observation, const Pose2& T_local_robot, const OccupancyGrid& seen,
                        double time_s) {
  follow_compass(observation, T_local_robot);
  if (running_ && time_s >= running_->begun_s + kAnswerAfter_s) {
    take(running_->answer.get());
    running_.reset();
    ++searches_;
    if (T_map_local()) return;
  }
  if (!belief_.drive(T_local_robot) || running_) return;
  std::optional<Pose2> T_map_robot_believed;
  if (T_map_local_believed_) T_map_robot_believed = *T_map_local_believed_ * T_local_robot;
  const auto search = [searched = searched_, around = surroundings_of(seen, T_local_robot),
                       turned = heading(T_local_robot), T_map_robot_believed] {
    if (!searched->search) searched->search.emplace(*searched->map);
    Answer answer{searched->search->find(around, turned), std::nullopt};
    if (T_map_robot_believed) answer.believed = searched->search->at(around, *T_map_robot_believed);
    return answer;
  };
  running_ = Search{std::async(std::launch::async, search), T_local_robot, time_s, belief_.driven_m()};
}

std::shared_ptr<std::future<SelfFinder::Answer>> SelfFinder::let_go() {
  if (!running_) return nullptr;
  auto search = std::make_shared<std::future<Answer>>(std::move(running_->answer));
  running_.reset();
  return search;
}

void SelfFinder::compare_with(const Pose2& T_map_start, const Pose2& T_local_robot) {
  const double turned_rad = wrap_angle(T_local_robot.theta_rad - T_map_start.theta_rad);
  const bool is_turned = std::abs(turned_rad) > compass_within_rad_;
  T_map_local_believed_ = is_turned ? T_map_start * inverse(T_local_robot) : Pose2{};
}

void SelfFinder::take(const Answer& answer) {
  belief_.update(answer.found, running_->T_local_robot);
  if (!answer.believed) return;
  PoseLook look{running_->driven_m, *answer.believed, std::nullopt};
  // Not from the best pose beside it, which a place some steps away has pulled towards itself.
  const Pose2 T_map_robot_believed = *T_map_local_believed_ * running_->T_local_robot;
  for (const PoseHypothesis& guess : answer.found) {
    if (is_same_place(guess.T_map_robot, T_map_robot_believed)) continue;
    look.elsewhere = guess;
    break;
  }
  looks_.push_back(std::move(look));
}

void SelfFinder::forget_markers() {
  marker_guess_.reset();
  by_marker_.reset();
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
