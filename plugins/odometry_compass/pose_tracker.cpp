#include "plugins/odometry_compass/pose_tracker.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace cairn::odometry_compass {
namespace {

// Further out than any robot gets; squares of what is beyond would drown every covariance.
constexpr double kFarthest_m = 1e6;
constexpr double kSmoothness = 6.0;
constexpr double kCrept = 3.0;           // how much more a slow drift has turned the heading than it shows
constexpr double kBiasBeforeSlip = 2.0;  // deviation of the bias over that of the heading when they have parted
// What steel turns a compass by changes less from place to place than a wheel that slips turns the robot.
constexpr double kFastestBias_radpm = radians(30.0);
constexpr double kStart_m = 0.05;   // of way
constexpr double kSettled_m = 0.8;  // of way, after which slow compasses have shown their noise
constexpr int kVerdict = 6;         // corrections by walls and landmarks until a suspicion is judged

bool is_usable(const Pose2& pose) {
  return std::abs(pose.x_m) <= kFarthest_m && std::abs(pose.y_m) <= kFarthest_m && std::isfinite(pose.theta_rad);
}

// A covariance of a position: symmetric, positive definite.
bool is_usable(const Eigen::Matrix2d& c) {
  return c.allFinite() && std::abs(c(0, 1) - c(1, 0)) <= 1e-9 * c.cwiseAbs().maxCoeff() && c(0, 0) > 0.0 &&
         c.determinant() > 0.0;
}

// Of a position and a heading.
bool is_usable(const Eigen::Matrix3d& c) {
  return c.allFinite() && (c - c.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * c.cwiseAbs().maxCoeff() &&
         c.llt().info() == Eigen::Success;
}

MotionNoise motion_noise_of(const Config& config, const RobotModel& robot, const CompassBias& bias) {
  MotionNoise noise;
  noise.along_ratio = std::max(config.min_distance_ratio, robot.odometry_error.distance_ratio);
  noise.across_ratio = config.min_distance_ratio;
  noise.heading_rad_per_m = std::max(config.min_heading_rad_per_m, robot.odometry_error.heading_rad_per_m);
  noise.turn_as_distance_m_per_rad = config.turn_as_distance_m_per_rad;
  noise.bias_rad = bias.deviation_rad;
  // The bias is a smooth function of the place, not of the path: over short distances it changes less than a
  // Gauss-Markov process of the same scale does, and it comes back where the robot comes back.
  noise.bias_scale_m = kSmoothness * std::max(0.01, robot.compass_error.local_bias_scale_m);
  return noise;
}

WallFinderRules wall_rules_of(const MotionNoise& noise, double compass_noise_rad) {
  WallFinderRules rules;
  rules.heading_noise_rad_per_m = noise.heading_rad_per_m;
  rules.compass_noise_rad = compass_noise_rad;
  return rules;
}

}  // namespace

PoseTracker::PoseTracker(const Config& config, const RobotModel& robot, const CompassBias& bias,
                         const Pose2& T_map_start, const StartUncertainty& start)
    : config_(config),
      motion_noise_(motion_noise_of(config, robot, bias)),
      use_compass_(config.use_compass && robot.has_compass),
      compass_noise_(std::max(config.min_compass_noise_rad, robot.compass_error.noise_rad)),
      bias_(bias),
      max_bias_rad_(bias.bound_rad),
      about_half_track_m_(robot.kinematics == Kinematics::differential ? robot.radius_m : 0.0),
      filter_(T_map_start, {std::max(config.start_position_m, start.position_m),
                            std::max(config.start_heading_rad, start.heading_rad),
                            robot.odometry_error.distance_bias_ratio, motion_noise_.bias_rad}),
      wall_finder_(wall_rules_of(motion_noise_, use_compass_ ? compass_noise_rad() : 0.0)) {}

PoseEstimate PoseTracker::update(const Observation& observation, std::span<const LandmarkSighting> sightings) {
  follow_odometry(observation.T_odom_robot);
  if (use_compass_ && observation.compass_rad) follow_compass(*observation.compass_rad, observation.stamp_s);
  const int walls = config_.use_walls ? follow_walls(observation) : 0;
  witnesses_ += walls;
  PoseEstimate estimate = correct(sightings);
  judge_suspect();
  estimate.sightings_used += walls;
  return estimate;
}

PoseEstimate PoseTracker::correct(std::span<const LandmarkSighting> sightings) {
  int used = 0;
  int refused = 0;
  for (const LandmarkSighting& sighting : sightings) ++(follow_landmark(sighting) ? used : refused);
  witnesses_ += used;
  PoseEstimate estimate = filter_.estimate();
  estimate.sightings_used = used;
  estimate.sightings_refused = refused;
  return estimate;
}

void PoseTracker::follow_odometry(const Pose2& T_odom_robot) {
  if (!is_usable(T_odom_robot)) return;
  if (T_odom_robot_) {
    const Pose2 step = inverse(*T_odom_robot_) * T_odom_robot;
    filter_.predict(step, motion_noise_);
    turned_rad_ += step.theta_rad;
    rolled_m_ += step.position().norm() + std::abs(step.theta_rad) * about_half_track_m_;
    last_step_ = step;
  }
  T_odom_robot_ = T_odom_robot;
}

void PoseTracker::follow_compass(double compass_rad, double stamp_s) {
  if (!std::isfinite(compass_rad)) return;
  if (compass_rad_) compass_noise_.add(wrap_angle(wrap_angle(compass_rad - *compass_rad_) - turned_rad_));
  jumped_ = jumped_ || has_jumped(compass_rad);
  drift_rolled_m_ = (1.0 - CompassDrift::kFastShare) * drift_rolled_m_ + rolled_m_;
  compass_rad_ = compass_rad;
  rolled_in_all_m_ += rolled_m_;
  turned_rad_ = 0.0;
  const double last_rolled_m = std::exchange(rolled_m_, 0.0);
  const double gate = config_.compass_gate_sigmas;
  const auto [off_rad, sigma_rad] = filter_.compare_heading(compass_rad, compass_noise_rad());
  const double off_sigmas = off_rad / sigma_rad;
  if (std::abs(off_sigmas) <= gate) {
    jumped_ = false;
    refused_since_s_.reset();
  } else if (!refused_since_s_) {
    refused_since_s_ = stamp_s;
  }
  const bool persists = refused_since_s_ && stamp_s - *refused_since_s_ >= config_.compass_refused_at_most_s;
  if (jumped_ && !persists) return;
  drift_.add(std::clamp(off_sigmas, -gate, gate));
  const double doubted_rad = std::max(std::abs(off_rad), std::abs(drift_.fast_sigmas()) * sigma_rad);
  const bool parts = !jumped_ && drift_.is_fast(config_.compass_drift_sigmas) && could_slip(doubted_rad);
  const bool noise_is_known = compass_noise_.is_settled() || rolled_in_all_m_ > kSettled_m;
  const bool is_sudden = doubted_rad > kFastestBias_radpm * drift_rolled_m_ ||
                         (std::abs(off_sigmas) > gate && std::abs(off_rad) > kFastestBias_radpm * last_rolled_m);
  const bool slips = parts && noise_is_known && is_sudden;
  const bool is_unbiased = bias_.deviation_rad == 0.0;
  const double before_rad = filter_.estimate().T_map_robot.theta_rad;
  if (slips || persists || (parts && is_unbiased && noise_is_known)) {
    filter_.doubt_heading(doubted_rad);
    drift_.restart();
    refused_since_s_.reset();
  } else if (parts && !is_unbiased && has_witness()) {
    suspect_bias(doubted_rad);
  } else if (!jumped_ && !is_unbiased && has_witness() && drift_.is_slow(config_.compass_drift_sigmas)) {
    suspect_bias(kCrept * std::abs(drift_.slow_sigmas()) * sigma_rad);
  }
  (void)filter_.correct_heading(compass_rad, compass_noise_rad(), gate);
  if (slips) follow_slip(wrap_angle(filter_.estimate().T_map_robot.theta_rad - before_rad));
  if (config_.bound_bias) filter_.bound_bias(max_bias_rad_);
}

bool PoseTracker::starts_biased() const {
  return bias_.deviation_rad == 0.0 && rolled_in_all_m_ < kStart_m && drift_.is_fast(config_.compass_drift_sigmas);
}

void PoseTracker::believe(const CompassBias& bias) {
  bias_ = bias;
  motion_noise_.bias_rad = bias.deviation_rad;
  max_bias_rad_ = bias.bound_rad;
  filter_.restart_bias(bias.deviation_rad);
  wall_finder_.rate_compass(use_compass_ ? compass_noise_rad() : 0.0);
  suspect_.reset();
  drift_.restart();
}

// The compass and the heading have parted, and one of them is wrong: the compass most likely, as something of steel is
// met more often than a wheel slips. Both are widened, so that the next walls and landmarks decide.
void PoseTracker::suspect_bias(double off_rad) {
  filter_.doubt_heading(off_rad);
  filter_.doubt_bias(kBiasBeforeSlip * off_rad);
  if (about_half_track_m_ > 0.0) filter_.slide(0.0, std::min(2.0 * off_rad * about_half_track_m_, drift_rolled_m_));
  motion_noise_.bias_rad = std::hypot(motion_noise_.bias_rad, kBiasBeforeSlip * off_rad);
  max_bias_rad_ = std::max(max_bias_rad_, CompassBias::kFar * motion_noise_.bias_rad);
  wall_finder_.rate_compass(0.0);
  suspect_ = Suspect{off_rad, witnesses_};
  drift_.restart();
  refused_since_s_.reset();
}

// After some more walls and landmarks the bias is known. Where there is next to none, a wheel had slipped, and the
// compass is what its file says.
void PoseTracker::judge_suspect() {
  if (!suspect_ || witnesses_ < suspect_->witnesses + kVerdict) return;
  if (std::abs(filter_.bias_rad()) < 0.5 * suspect_->off_rad) {
    motion_noise_.bias_rad = bias_.deviation_rad;
    max_bias_rad_ = std::max(bias_.bound_rad, std::abs(filter_.bias_rad()));
    wall_finder_.rate_compass(compass_noise_rad());
  }
  suspect_.reset();
}

// The compass itself has turned, and it and the odometry have parted by more than a wheel that slips could make them.
bool PoseTracker::has_jumped(double compass_rad) const {
  if (!compass_rad_) return false;
  const double noise_rad = config_.compass_jump_sigmas * std::numbers::sqrt2 * compass_noise_rad();
  const double slip_rad = about_half_track_m_ > 0.0 ? rolled_m_ / (2.0 * about_half_track_m_) : 0.0;
  const double turned_rad = wrap_angle(compass_rad - *compass_rad_);
  return std::abs(turned_rad) > noise_rad && std::abs(wrap_angle(turned_rad - turned_rad_)) > noise_rad + slip_rad;
}

// Whether the wheels have rolled far enough for half of it. Nobody knows of a car's.
bool PoseTracker::could_slip(double turned_rad) const {
  return about_half_track_m_ <= 0.0 ? drift_rolled_m_ > 0.0 : drift_rolled_m_ >= turned_rad * about_half_track_m_;
}

// A wheel that slips turns the robot, and the robot has gone less far: where only one of the wheels, by the distance
// that it turned, can have done so, that is known, about.
void PoseTracker::follow_slip(double turned_rad) {
  if (about_half_track_m_ <= 0.0) return;
  const double lost_m = std::min(std::abs(turned_rad) * about_half_track_m_, 0.5 * drift_rolled_m_);
  const double across_m = last_step_.theta_rad * about_half_track_m_;
  const double left_m = last_step_.x_m - across_m;
  const double right_m = last_step_.x_m + across_m;
  const bool left_may = left_m * turned_rad > 0.0;
  const bool right_may = right_m * turned_rad < 0.0;
  const double along_m = left_may == right_may ? 0.0 : std::copysign(lost_m, left_may ? -left_m : -right_m);
  // The pieces of one slip err the same way, so that each counts for more than its own error.
  filter_.slide(along_m, along_m == 0.0 ? 2.0 * lost_m : lost_m);
}

// A wall that has just been met counts the more the nearer it was to where it should be. Of walls that were drawn since
// the restart the other tracker knows nothing: whoever draws one twice would seem to know more.
void PoseTracker::count_wall(int wall) {
  if (wall >= walls_that_count_) return;
  wall_evidence_ += 0.5 * (config_.wall_gate_sigmas * config_.wall_gate_sigmas - filter_.last_off_squared_sigmas());
}

int PoseTracker::follow_walls(const Observation& observation) {
  if (!is_usable(observation.T_odom_robot)) return 0;
  wall_finder_.take(observation);
  if (!wall_finder_.is_due()) return 0;
  int used = 0;
  std::array<ExpectedWall, PoseFilter::kMaxWalls> expected;
  const std::span<ExpectedWall> all(expected.data(), static_cast<std::size_t>(filter_.walls()));
  for (int wall = 0; wall < filter_.walls(); ++wall) expected[static_cast<std::size_t>(wall)] = filter_.expected(wall);
  for (const ExpectedWall& wall : all) {
    const std::optional<SeenWall> again = wall_finder_.look_for(wall, all);
    if (again && filter_.meet_again(wall.wall, *again, config_.wall_gate_sigmas)) {
      ++used;
      count_wall(wall.wall);
    }
  }
  const std::optional<SeenWall> seen = wall_finder_.find();
  if (seen && filter_.meet(*seen, config_.wall_gate_sigmas) == PoseFilter::WallUse::known) {
    ++used;
    count_wall(filter_.last_met());
  }
  return used;
}

bool PoseTracker::follow_landmark(const LandmarkSighting& sighting) {
  const Eigen::Matrix3d& seen = sighting.covariance;
  const bool usable = is_usable(sighting.T_map_landmark) && is_usable(sighting.T_robot_landmark) && seen.allFinite() &&
                      is_usable(Eigen::Matrix2d(seen.topLeftCorner<2, 2>()));
  if (!usable) return false;
  if (correct_by(sighting)) {
    refused_places_ = 0;
    return true;
  }
  const Point off =
      sighting.T_map_landmark.position() - filter_.estimate().T_map_robot * sighting.T_robot_landmark.position();
  const bool agrees = refused_places_ > 0 && (off - refused_off_m_).norm() <= config_.refusals_agree_m;
  refused_places_ = agrees ? refused_places_ + 1 : 1;
  refused_off_m_ = off;
  if (refused_places_ < config_.landmark_refusals) return false;
  filter_.doubt_position(sighting.T_map_landmark.position(), sighting.T_robot_landmark.position());
  refused_places_ = 0;
  return correct_by(sighting);
}

bool PoseTracker::correct_by(const LandmarkSighting& sighting) {
  const double map_variance = config_.landmark_noise_m * config_.landmark_noise_m;
  Eigen::Matrix3d noise = sighting.covariance;
  noise(0, 0) += map_variance;
  noise(1, 1) += map_variance;
  if (config_.use_landmark_heading && is_usable(noise))
    return filter_.correct_pose(sighting.T_map_landmark, sighting.T_robot_landmark, noise,
                                config_.landmark_gate_sigmas);
  return filter_.correct_position(sighting.T_map_landmark.position(), sighting.T_robot_landmark.position(),
                                  noise.topLeftCorner<2, 2>(), config_.landmark_gate_sigmas);
}

}  // namespace cairn::odometry_compass
