#include "plugins/odometry_compass/pose_filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cairn::odometry_compass {
namespace {

constexpr double kBeside_m = 2.5;       // a wall goes on at least so far beyond what has been met of it
constexpr double kSurely_sigmas = 6.0;  // further off than this from every known wall: a new one
constexpr double kSameDirection_rad = radians(25.0);
constexpr double kSamePlace_m = 0.6;
constexpr double kFurthestCut_sigmas = 8.0;  // beyond, the tail is too thin for its moments
constexpr double kRootTwoPi = std::numbers::sqrt2 / std::numbers::inv_sqrtpi;
constexpr double kAmbiguous = 4.0;  // squared distance by which the best must lead

constexpr double squared(double x) {
  return x * x;
}

Eigen::Matrix2d rotation(double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

}  // namespace

PoseFilter::PoseFilter(const Pose2& T_map_robot, const Start& deviations)
    : state_(State::Zero(kPoseStates)), covariance_(Covariance::Zero(kPoseStates, kPoseStates)) {
  state_.head<3>() << T_map_robot.x_m, T_map_robot.y_m, wrap_angle(T_map_robot.theta_rad);
  covariance_.diagonal() << squared(deviations.position_m), squared(deviations.position_m),
      squared(deviations.heading_rad), squared(deviations.scale_ratio), squared(deviations.bias_rad);
}

void PoseFilter::predict(const Pose2& T_before_after, const MotionNoise& noise) {
  using PoseBlock = Eigen::Matrix<double, kPoseStates, kPoseStates>;
  // Odometry counts (1 + scale) metres for each metre.
  const Point seen = T_before_after.position();
  const Point moved = seen / (1.0 + state_[kScale]);
  const double distance_m = moved.norm();
  const double turn_rad = std::abs(T_before_after.theta_rad);
  if (distance_m == 0.0 && turn_rad == 0.0) return;
  const double kept = std::exp(-distance_m / noise.bias_scale_m);

  const Eigen::Matrix2d to_map = rotation(state_[kTheta]);
  const Point step = to_map * moved;
  PoseBlock f = PoseBlock::Identity();
  f(0, kTheta) = -step.y();
  f(1, kTheta) = step.x();
  f.block<2, 1>(0, kScale) = -step / (1.0 + state_[kScale]);
  f(kBias, kBias) = kept;

  PoseBlock q = PoseBlock::Zero();
  const Point forward = distance_m > 0.0 ? Point(step / distance_m) : Point(0.0, 0.0);
  const Point sideways{-forward.y(), forward.x()};
  q.topLeftCorner<2, 2>() = distance_m * (squared(noise.along_ratio) * forward * forward.transpose() +
                                          squared(noise.across_ratio) * sideways * sideways.transpose());
  q(kTheta, kTheta) = squared(noise.heading_rad_per_m) * (distance_m + noise.turn_as_distance_m_per_rad * turn_rad);
  q(kBias, kBias) = squared(noise.bias_rad) * (1.0 - kept * kept);

  state_.head<2>() += step;
  state_[kTheta] = wrap_angle(state_[kTheta] + T_before_after.theta_rad);
  state_[kBias] *= kept;
  const PoseBlock pose = covariance_.topLeftCorner<kPoseStates, kPoseStates>();
  covariance_.topLeftCorner<kPoseStates, kPoseStates>() = f * pose * f.transpose() + q;
  for (Eigen::Index i = kPoseStates; i < covariance_.cols(); ++i) {
    const Eigen::Matrix<double, kPoseStates, 1> with_wall = f * covariance_.col(i).head<kPoseStates>();
    covariance_.col(i).head<kPoseStates>() = with_wall;
    covariance_.row(i).head<kPoseStates>() = with_wall.transpose();
  }
}

bool PoseFilter::correct_heading(double compass_rad, double noise_rad, double gate_sigmas) {
  Slope<1> h;
  h.pose(0, kTheta) = 1.0;
  h.pose(0, kBias) = 1.0;
  const Eigen::Matrix<double, 1, 1> innovation(wrap_angle(compass_rad - state_[kTheta] - state_[kBias]));
  return correct<1>(innovation, h, Eigen::Matrix<double, 1, 1>(squared(noise_rad)), gate_sigmas);
}

PoseFilter::HeadingOff PoseFilter::compare_heading(double compass_rad, double noise_rad) const {
  const double variance =
      covariance_(kTheta, kTheta) + 2.0 * covariance_(kTheta, kBias) + covariance_(kBias, kBias) + squared(noise_rad);
  return {wrap_angle(compass_rad - state_[kTheta] - state_[kBias]), std::sqrt(variance)};
}

void PoseFilter::doubt_heading(double off_rad) {
  covariance_(kTheta, kTheta) += squared(off_rad);
}

void PoseFilter::doubt_bias(double off_rad) {
  covariance_(kBias, kBias) += squared(off_rad);
}

void PoseFilter::restart_bias(double deviation_rad) {
  state_[kBias] = 0.0;
  covariance_.row(kBias).setZero();
  covariance_.col(kBias).setZero();
  covariance_(kBias, kBias) = squared(deviation_rad);
}

void PoseFilter::slide(double along_m, double deviation_m) {
  const Point ahead = unit_vector(state_[kTheta]);
  state_.head<2>() += along_m * ahead;
  covariance_.topLeftCorner<2, 2>() += squared(deviation_m) * ahead * ahead.transpose();
}

void PoseFilter::bound_bias(double max_rad) {
  const double beyond_rad = std::abs(state_[kBias]) - max_rad;
  const double variance = covariance_(kBias, kBias);
  if (!(beyond_rad > 0.0) || !(variance > 0.0)) return;
  const double sigma = std::sqrt(variance);
  const double cut = std::max(-kFurthestCut_sigmas, -beyond_rad / sigma);
  const double hazard = std::exp(-0.5 * squared(cut)) / (0.5 * std::erfc(-cut / std::numbers::sqrt2) * kRootTwoPi);
  const double less_rad = std::copysign(std::max(beyond_rad, sigma * hazard), state_[kBias]);
  const double less_ratio = std::clamp(hazard * (cut + hazard), 0.0, 1.0);  // of the variance
  const State with = covariance_.col(kBias) / variance;
  state_ -= with * less_rad;
  state_[kTheta] = wrap_angle(state_[kTheta]);
  for (int wall = 0; wall < walls_; ++wall) state_[kPoseStates + 2 * wall] = wrap_angle(state_[kPoseStates + 2 * wall]);
  for (Eigen::Index i = 0; i < covariance_.cols(); ++i)
    for (Eigen::Index j = i; j < covariance_.cols(); ++j) {
      covariance_(i, j) -= with[i] * (variance * less_ratio) * with[j];
      covariance_(j, i) = covariance_(i, j);
    }
}

bool PoseFilter::correct_position(const Point& p_map, const Point& p_robot, const Eigen::Matrix2d& noise,
                                  double gate_sigmas) {
  const Eigen::Matrix2d to_robot = rotation(-state_[kTheta]);
  const Point expected = to_robot * (p_map - state_.head<2>());
  Slope<2> h;
  h.pose.leftCols<2>() = -to_robot;
  h.pose(0, kTheta) = expected.y();
  h.pose(1, kTheta) = -expected.x();
  return correct<2>(p_robot - expected, h, noise, gate_sigmas);
}

bool PoseFilter::correct_pose(const Pose2& T_map_landmark, const Pose2& T_robot_landmark, const Eigen::Matrix3d& noise,
                              double gate_sigmas) {
  const Eigen::Matrix2d to_robot = rotation(-state_[kTheta]);
  const Point expected = to_robot * (T_map_landmark.position() - state_.head<2>());
  Slope<3> h;
  h.pose.topLeftCorner<2, 2>() = -to_robot;
  h.pose(0, kTheta) = expected.y();
  h.pose(1, kTheta) = -expected.x();
  h.pose(2, kTheta) = -1.0;
  Eigen::Vector3d innovation;
  innovation.head<2>() = T_robot_landmark.position() - expected;
  innovation[2] = wrap_angle(T_robot_landmark.theta_rad - T_map_landmark.theta_rad + state_[kTheta]);
  return correct<3>(innovation, h, noise, gate_sigmas);
}

void PoseFilter::doubt_position(const Point& p_map, const Point& p_robot) {
  const Point off = p_map - rotation(state_[kTheta]) * p_robot - state_.head<2>();
  covariance_.topLeftCorner<2, 2>() += off * off.transpose();
}

template <int kRows>
Eigen::Matrix<double, kRows, kRows> PoseFilter::spread(const Slope<kRows>& h,
                                                       const Eigen::Matrix<double, kRows, kRows>& noise) const {
  Eigen::Matrix<double, kRows, kRows> s =
      h.pose * covariance_.topLeftCorner<kPoseStates, kPoseStates>() * h.pose.transpose() + noise;
  if (h.wall_state < 0) return s;
  const Eigen::Matrix<double, kRows, kRows> between =
      h.pose * covariance_.block<kPoseStates, 2>(0, h.wall_state) * h.wall.transpose();
  s +=
      between + between.transpose() + h.wall * covariance_.block<2, 2>(h.wall_state, h.wall_state) * h.wall.transpose();
  return s;
}

template <int kRows>
bool PoseFilter::correct(const Eigen::Matrix<double, kRows, 1>& innovation, const Slope<kRows>& h,
                         const Eigen::Matrix<double, kRows, kRows>& noise, double gate_sigmas) {
  const Eigen::Matrix<double, kRows, kRows> s_inverse = spread<kRows>(h, noise).inverse();
  const double off = innovation.dot(s_inverse * innovation);
  last_off_ = off;
  if (!(off <= squared(gate_sigmas))) return false;
  using Gain = Eigen::Matrix<double, Eigen::Dynamic, kRows, kRows == 1 ? Eigen::ColMajor : 0, kMaxStates, kRows>;
  Gain with = covariance_.leftCols<kPoseStates>() * h.pose.transpose();
  if (h.wall_state >= 0) with.noalias() += covariance_.middleCols<2>(h.wall_state) * h.wall.transpose();
  const Gain gain = with * s_inverse;
  state_ += gain * innovation;
  state_[kTheta] = wrap_angle(state_[kTheta]);
  for (int wall = 0; wall < walls_; ++wall) state_[kPoseStates + 2 * wall] = wrap_angle(state_[kPoseStates + 2 * wall]);
  // Joseph's form, multiplied out: stays symmetric and positive whatever the rounding.
  //   (1 - KH) P (1 - KH)' + K R K' = P - K W' - W K' + K S K',   W = P H'
  const Eigen::Matrix<double, kRows, kRows> s = s_inverse.inverse();
  for (Eigen::Index i = 0; i < covariance_.cols(); ++i)
    for (Eigen::Index j = i; j < covariance_.cols(); ++j) {
      const double less =
          gain.row(i).dot(with.row(j)) + with.row(i).dot(gain.row(j)) - (gain.row(i) * s).dot(gain.row(j));
      covariance_(i, j) -= less;
      covariance_(j, i) = covariance_(i, j);
    }
  return true;
}

// A seen wall against a known one.
struct PoseFilter::Match {
  Eigen::Vector2d innovation;
  Slope<2> h;
  double squared_sigmas = std::numeric_limits<double>::infinity();
  bool is_alike = false;  // about there, about so turned, about that stretch
};

PoseFilter::Match PoseFilter::compare(int wall, const SeenWall& seen) const {
  Match match;
  const int at = kPoseStates + 2 * wall;
  const Wall& known = wall_[static_cast<std::size_t>(wall)];
  const Point normal = unit_vector(state_[at]);
  const Point from_wall = state_.head<2>() - known.from_m;
  match.innovation = {wrap_angle(seen.bearing_rad - state_[at] + state_[kTheta]),
                      seen.distance_m - state_[at + 1] + normal.dot(from_wall)};
  match.h.pose(0, kTheta) = -1.0;
  match.h.pose.block<1, 2>(1, 0) = -normal.transpose();
  match.h.wall(0, 0) = 1.0;
  match.h.wall(1, 0) = -to_left(normal).dot(from_wall);
  match.h.wall(1, 1) = 1.0;
  match.h.wall_state = at;
  const double foot_m = to_left(normal).dot(from_wall);
  match.is_alike = std::abs(match.innovation[0]) < kSameDirection_rad && std::abs(match.innovation[1]) < kSamePlace_m &&
                   foot_m + seen.begin_m < known.end_m + kBeside_m && foot_m + seen.end_m > known.begin_m - kBeside_m;
  if (match.is_alike) {
    const Eigen::Matrix2d s = spread<2>(match.h, seen.covariance);
    match.squared_sigmas = match.innovation.dot(s.inverse() * match.innovation);
  }
  return match;
}

ExpectedWall PoseFilter::expected(int wall) const {
  const Match match = compare(wall, {});
  const Wall& known = wall_[static_cast<std::size_t>(wall)];
  const double foot_m = to_left(unit_vector(state_[kPoseStates + 2 * wall])).dot(state_.head<2>() - known.from_m);
  return {wall,
          -match.innovation[0],
          -match.innovation[1],
          std::sqrt(std::max(0.0, spread<2>(match.h, Eigen::Matrix2d::Zero())(1, 1))),
          known.begin_m - foot_m,
          known.end_m - foot_m};
}

bool PoseFilter::meet_again(int wall, const SeenWall& seen, double gate_sigmas) {
  const Match match = compare(wall, seen);
  if (!correct<2>(match.innovation, match.h, seen.covariance, gate_sigmas)) return false;
  stretch(wall, seen);
  return true;
}

PoseFilter::WallUse PoseFilter::meet(const SeenWall& seen, double gate_sigmas) {
  Match best;
  int which = -1;
  double next = std::numeric_limits<double>::infinity();
  for (int wall = 0; wall < walls_; ++wall) {
    const Match match = compare(wall, seen);
    if (!match.is_alike) continue;
    if (match.squared_sigmas < best.squared_sigmas) {
      next = best.squared_sigmas;
      best = match;
      which = wall;
    } else {
      next = std::min(next, match.squared_sigmas);
    }
  }
  if (which >= 0 && best.squared_sigmas <= squared(kSurely_sigmas)) {
    if (next < best.squared_sigmas + kAmbiguous) return WallUse::refused;
    if (!correct<2>(best.innovation, best.h, seen.covariance, gate_sigmas)) return WallUse::refused;
    stretch(which, seen);
    last_met_ = which;
    return WallUse::known;
  }
  if (!seen.is_conservatively_straight || (walls_ == kMaxWalls && !forget_one())) return WallUse::refused;
  add(seen);
  return WallUse::added;
}

void PoseFilter::stretch(int wall, const SeenWall& seen) {
  Wall& known = wall_[static_cast<std::size_t>(wall)];
  const Point normal = unit_vector(state_[kPoseStates + 2 * wall]);
  const double foot_m = to_left(normal).dot(state_.head<2>() - known.from_m);
  known.begin_m = std::min(known.begin_m, foot_m + seen.begin_m);
  known.end_m = std::max(known.end_m, foot_m + seen.end_m);
  ++known.meetings;
}

void PoseFilter::add(const SeenWall& seen) {
  const double normal_rad = wrap_angle(state_[kTheta] + seen.bearing_rad);
  const Point normal = unit_vector(normal_rad);
  const int at = kPoseStates + 2 * walls_;
  // The pose's errors are the wall's, turned; its own noise comes on top.
  Eigen::Matrix<double, 2, kPoseStates> g = Eigen::Matrix<double, 2, kPoseStates>::Zero();
  g(0, kTheta) = 1.0;
  g.block<1, 2>(1, 0) = normal.transpose();
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kMaxStates> with = g * covariance_.topRows<kPoseStates>();
  const Eigen::Matrix2d own = with.leftCols<kPoseStates>() * g.transpose() + seen.covariance;
  state_.conservativeResize(at + 2);
  covariance_.conservativeResize(at + 2, at + 2);
  state_[at] = normal_rad;
  state_[at + 1] = 0.0;
  covariance_.block(at, 0, 2, at) = with;
  covariance_.block(0, at, at, 2) = with.transpose();
  covariance_.block<2, 2>(at, at) = own;
  wall_[static_cast<std::size_t>(walls_)] = {Point(state_.head<2>() + seen.distance_m * normal), seen.begin_m,
                                             seen.end_m, 1};
  ++walls_;
}

// The first of those that were met once only makes room: most likely it was none. False: all were met again.
bool PoseFilter::forget_one() {
  const auto end = wall_.begin() + walls_;
  const auto found = std::find_if(wall_.begin(), end, [](const Wall& wall) { return wall.meetings < 2; });
  if (found == end) return false;
  const int at = kPoseStates + 2 * static_cast<int>(found - wall_.begin());
  const int rest = static_cast<int>(state_.size()) - at - 2;
  std::copy(found + 1, end, found);
  for (int i = at; i < at + rest; ++i) {
    state_[i] = state_[i + 2];
    covariance_.row(i) = covariance_.row(i + 2);
  }
  for (int i = at; i < at + rest; ++i) covariance_.col(i) = covariance_.col(i + 2);
  --walls_;
  state_.conservativeResize(at + rest);
  covariance_.conservativeResize(at + rest, at + rest);
  return true;
}

PoseEstimate PoseFilter::estimate() const {
  PoseEstimate estimate;
  estimate.T_map_robot = {state_[0], state_[1], state_[kTheta]};
  estimate.covariance = covariance_.topLeftCorner<3, 3>();
  return estimate;
}

}  // namespace cairn::odometry_compass
