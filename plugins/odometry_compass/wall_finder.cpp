#include "plugins/odometry_compass/wall_finder.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn::odometry_compass {
namespace {

constexpr double kStep_rad = 2.0 * std::numbers::pi / 120.0;
constexpr double kStep_m = 0.05;
constexpr double kBeyond_m = 1.5;         // a line may lie behind the robot by so much: it has turned round its end
constexpr double kBeamRatio = 1.0;        // of the half-beam in which walls answer
constexpr double kBesideSegment_m = 1.0;  // beyond the ends of a known wall
constexpr double kGate_m = 0.07;
constexpr double kWidestGate_m = 0.3;
constexpr int kMinAgain = 4;  // echoes of a known wall
constexpr double kHeld_rad = radians(10.0);
constexpr double kSteadied_rad = radians(1.0);
constexpr double kCommon_rad = radians(0.5);
constexpr double kCommon_m = 0.010;
constexpr int kPeaks = 4;
constexpr int kBatch = 8;             // new echoes before the next search
constexpr double kPointRatio = 0.75;  // a line must fit so much better than a point
constexpr double kCurved_m = 0.010;   // how far a round thing must leave the line to be distinguished from it

}  // namespace

struct WallFinder::Fit {
  Line line;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  double rms_m = 0.0;
  double begin_m = 0.0;  // feet of the echoes along the line, from the robot's own
  double end_m = 0.0;
  double nearest_m = 0.0;
  double way_m = 0.0;  // driven since the first of them
  int echoes = 0;
};

struct WallFinder::Demands {
  int echoes;
  double span_m;
  double hold;  // information on the direction
  double held_rad;
};

WallFinder::WallFinder(const WallFinderRules& rules) : rules_(rules), votes_(kDirections * kDistances) {
  echoes_.reserve(kMaxEchoes);
  chosen_.reserve(kMaxEchoes);
  offs_m_.reserve(kMaxEchoes);
}

void WallFinder::take(const Observation& observation) {
  if (begun_) {
    const Pose2 step = inverse(T_odom_last_) * observation.T_odom_robot;
    driven_m_ += step.position().norm();
    steady(step, observation.compass_rad);
  }
  begun_ = true;
  T_odom_last_ = observation.T_odom_robot;
  stamp_s_ = observation.stamp_s;
  for (const RangeReading& range : observation.ranges) {
    const bool is_echo = range.half_beam_rad > 0.0 && std::isfinite(range.range_m) && range.range_m >= range.min_m &&
                         range.range_m <= std::min(range.max_m, rules_.max_range_m);
    if (!is_echo) continue;
    if (static_cast<int>(echoes_.size()) == kMaxEchoes) echoes_.erase(echoes_.begin());
    const Pose2 T_odom_sensor = T_odom_robot_ * range.T_robot_sensor;
    echoes_.push_back(
        {T_odom_sensor.position(), T_odom_sensor.theta_rad, range.half_beam_rad, range.range_m, driven_m_, stamp_s_});
    ++new_echoes_;
  }
}

// The odometry's path with a heading that the compass keeps: a scalar Kalman filter. What the compass is off by hardly
// changes over the length of a memory.
void WallFinder::steady(const Pose2& step, const std::optional<double>& compass_rad) {
  T_odom_robot_ = T_odom_robot_ * step;
  const double way_m = step.position().norm() + 0.1 * std::abs(step.theta_rad);
  heading_variance_ += rules_.heading_noise_rad_per_m * rules_.heading_noise_rad_per_m * way_m;
  if (!compass_rad || !std::isfinite(*compass_rad) || rules_.compass_noise_rad <= 0.0) return;
  const double off_rad = wrap_angle(*compass_rad - T_odom_robot_.theta_rad);
  if (heading_variance_ > 0.1 || std::abs(off_rad) > 0.5) {  // no longer the same window
    echoes_.clear();
    T_odom_robot_.theta_rad = *compass_rad;
    heading_variance_ = rules_.compass_noise_rad * rules_.compass_noise_rad;
    return;
  }
  const double share = heading_variance_ / (heading_variance_ + rules_.compass_noise_rad * rules_.compass_noise_rad);
  T_odom_robot_.theta_rad = wrap_angle(T_odom_robot_.theta_rad + share * off_rad);
  heading_variance_ *= 1.0 - share;
}

void WallFinder::forget_old() {
  std::erase_if(echoes_, [&](const Echo& echo) {
    return echo.driven_m < driven_m_ - rules_.memory_m || echo.stamp_s < stamp_s_ - rules_.memory_s;
  });
}

bool WallFinder::is_due() const {
  return new_echoes_ >= kBatch;
}

// How much further away an echo puts a wall than it should be; none when it is none of this wall.
std::optional<double> WallFinder::off_m(const Echo& echo, const ExpectedWall& wall) const {
  const double normal_rad = T_odom_robot_.theta_rad + wall.bearing_rad;
  if (std::abs(wrap_angle(echo.axis_rad - normal_rad)) > kBeamRatio * echo.half_beam_rad) return std::nullopt;
  const Point normal = unit_vector(normal_rad);
  const Point from_m = echo.at_m - T_odom_robot_.position();
  const double foot_m = to_left(normal).dot(from_m);
  if (foot_m < wall.begin_m - kBesideSegment_m || foot_m > wall.end_m + kBesideSegment_m) return std::nullopt;
  return normal.dot(from_m) + echo.range_m - wall.distance_m;
}

std::optional<SeenWall> WallFinder::look_for(const ExpectedWall& wall, std::span<const ExpectedWall> all) {
  const double gate_m = std::min(kWidestGate_m, kGate_m + 2.5 * wall.deviation_m);
  chosen_.clear();
  offs_m_.clear();
  for (std::size_t i = 0; i < echoes_.size(); ++i) {
    const std::optional<double> off = off_m(echoes_[i], wall);
    if (!off || std::abs(*off) > gate_m) continue;
    const bool is_others = std::ranges::any_of(all, [&](const ExpectedWall& other) {
      if (other.wall == wall.wall) return false;
      const std::optional<double> there = off_m(echoes_[i], other);
      return there && std::abs(*there) <= std::abs(*off);
    });
    if (is_others) continue;
    chosen_.push_back(static_cast<int>(i));
    offs_m_.push_back(*off);
  }
  if (static_cast<int>(chosen_.size()) < kMinAgain) return std::nullopt;
  std::nth_element(offs_m_.begin(), offs_m_.begin() + static_cast<std::ptrdiff_t>(offs_m_.size() / 2), offs_m_.end());
  Line line{wrap_angle(T_odom_robot_.theta_rad + wall.bearing_rad), wall.distance_m + offs_m_[offs_m_.size() / 2]};
  // A short look says little of the direction, which then stays as it was.
  const double hold = rules_.range_noise_m * rules_.range_noise_m / (kHeld_rad * kHeld_rad);
  const double expected_rad = line.normal_rad;
  const std::optional<Fit> found = fit(line, {kMinAgain, 0.0, hold, expected_rad});
  if (!found || found->echoes < 0.6 * static_cast<double>(chosen_.size())) return std::nullopt;
  const SeenWall again = seen(*found);
  std::erase_if(echoes_, [&](const Echo& echo) { return speaks_for(echo, found->line, rules_.inlier_m); });
  return again;
}

std::optional<SeenWall> WallFinder::find() {
  new_echoes_ = 0;
  forget_old();
  if (!count_votes()) return std::nullopt;
  for (int peak = 0; peak < kPeaks; ++peak) {
    const std::optional<Line> winner = strongest();
    if (!winner) return std::nullopt;
    const std::optional<Fit> found = fit(*winner, {rules_.min_echoes, rules_.min_span_m, 0.0, 0.0});
    if (!found || found->rms_m > kPointRatio * point_rms_m(found->line)) continue;
    const SeenWall wall = seen(*found);
    std::erase_if(echoes_, [&](const Echo& echo) { return speaks_for(echo, found->line, rules_.inlier_m); });
    return wall;
  }
  return std::nullopt;
}

bool WallFinder::count_votes() {
  if (static_cast<int>(echoes_.size()) < rules_.min_echoes) return false;
  std::fill(votes_.begin(), votes_.end(), std::uint16_t{0});
  const Point here_m = T_odom_robot_.position();
  for (const Echo& echo : echoes_) {
    const Point from_m = echo.at_m - here_m;
    const int first = static_cast<int>(std::ceil((echo.axis_rad - kBeamRatio * echo.half_beam_rad) / kStep_rad));
    const int last = static_cast<int>(std::floor((echo.axis_rad + kBeamRatio * echo.half_beam_rad) / kStep_rad));
    for (int i = first; i <= last; ++i) {
      const double distance_m = unit_vector(i * kStep_rad).dot(from_m) + echo.range_m;
      const int bin = static_cast<int>(std::floor((distance_m + kBeyond_m) / kStep_m));
      if (bin < 0 || bin + 1 >= kDistances) continue;
      const int row = ((i % kDirections) + kDirections) % kDirections;
      // Twice as fine as a bin: neighbours overlap.
      ++votes_[vote_index(row, bin)];
      const double in_bin = (distance_m + kBeyond_m) / kStep_m - bin;
      const int next = in_bin < 0.5 ? bin - 1 : bin + 1;
      if (next >= 0) ++votes_[vote_index(row, next)];
    }
  }
  return true;
}

// And takes the votes about it away, so that the next one is another.
std::optional<WallFinder::Line> WallFinder::strongest() {
  const auto best = std::max_element(votes_.begin(), votes_.end());
  if (*best < rules_.min_echoes) return std::nullopt;
  const int at = static_cast<int>(best - votes_.begin());
  const int best_row = at / kDistances;
  const int best_bin = at % kDistances;
  for (int i = -3; i <= 3; ++i)
    for (int k = -3; k <= 3; ++k) {
      const int bin = best_bin + k;
      const int row = (best_row + i + kDirections) % kDirections;
      if (bin >= 0 && bin < kDistances) votes_[vote_index(row, bin)] = 0;
    }
  return Line{wrap_angle(best_row * kStep_rad), (best_bin + 0.5) * kStep_m - kBeyond_m};
}

bool WallFinder::speaks_for(const Echo& echo, const Line& line, double within_m) const {
  if (std::abs(wrap_angle(echo.axis_rad - line.normal_rad)) > kBeamRatio * echo.half_beam_rad) return false;
  const double distance_m = unit_vector(line.normal_rad).dot(echo.at_m - T_odom_robot_.position()) + echo.range_m;
  return std::abs(distance_m - line.distance_m) <= within_m;
}

std::optional<WallFinder::Fit> WallFinder::fit(Line line, const Demands& demands) const {
  const Point here_m = T_odom_robot_.position();
  Fit found;
  for (const double within : {1.6, 1.2, 1.0, 1.0}) {
    const Point normal = unit_vector(line.normal_rad);
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    information(0, 0) = demands.hold;
    gradient[0] = demands.hold * wrap_angle(demands.held_rad - line.normal_rad);
    double squares = 0.0;
    found = {};
    found.begin_m = found.nearest_m = 1e9;
    found.end_m = -1e9;
    for (const Echo& echo : echoes_) {
      if (!speaks_for(echo, line, within * rules_.inlier_m)) continue;
      const Point from_m = echo.at_m - here_m;
      const double along_m = to_left(normal).dot(from_m);
      const double off_m = normal.dot(from_m) + echo.range_m - line.distance_m;
      const Eigen::Vector2d slope(-along_m, 1.0);
      information += slope * slope.transpose();
      gradient += off_m * slope;
      squares += off_m * off_m;
      found.begin_m = std::min(found.begin_m, along_m);
      found.end_m = std::max(found.end_m, along_m);
      found.nearest_m = std::min(found.nearest_m, echo.range_m);
      found.way_m = std::max(found.way_m, driven_m_ - echo.driven_m);
      ++found.echoes;
    }
    if (found.echoes < demands.echoes || found.end_m - found.begin_m < demands.span_m) return std::nullopt;
    found.covariance = information.inverse();
    const Eigen::Vector2d step = found.covariance * gradient;
    found.rms_m = std::sqrt(squares / found.echoes);
    found.line = line;
    line.normal_rad = wrap_angle(line.normal_rad + step[0]);
    line.distance_m += step[1];
  }
  if (found.rms_m > rules_.max_rms_m) return std::nullopt;
  return found;
}

// How well the same echoes would fit a point, the best one near the line's foot.
double WallFinder::point_rms_m(const Line& line) const {
  const Point here_m = T_odom_robot_.position();
  Point point_m{0.0, 0.0};
  int count = 0;
  for (const Echo& echo : echoes_) {
    if (!speaks_for(echo, line, rules_.inlier_m)) continue;
    point_m += echo.at_m - here_m + echo.range_m * unit_vector(line.normal_rad);
    ++count;
  }
  point_m /= std::max(count, 1);
  double squares = 0.0;
  for (int i = 0; i < 5; ++i) {
    Eigen::Matrix2d information = 1e-6 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    squares = 0.0;
    for (const Echo& echo : echoes_) {
      if (!speaks_for(echo, line, rules_.inlier_m)) continue;
      const Point offset = point_m - (echo.at_m - here_m);
      const double range_m = std::max(offset.norm(), 1e-3);
      const Point slope = offset / range_m;
      information += slope * slope.transpose();
      gradient += (echo.range_m - range_m) * slope;
      squares += (echo.range_m - range_m) * (echo.range_m - range_m);
    }
    point_m += information.inverse() * gradient;
  }
  return std::sqrt(squares / std::max(count, 1));
}

SeenWall WallFinder::seen(const Fit& fit) const {
  SeenWall wall;
  wall.bearing_rad = wrap_angle(fit.line.normal_rad - T_odom_robot_.theta_rad);
  wall.distance_m = fit.line.distance_m;
  const double noise_m = std::max(rules_.range_noise_m, fit.rms_m);
  wall.covariance = noise_m * noise_m * fit.covariance;
  // Odometry between the echoes, and what is the same in all of them.
  wall.covariance(0, 0) += std::min(rules_.heading_noise_rad_per_m * rules_.heading_noise_rad_per_m * fit.way_m / 3.0,
                                    kSteadied_rad * kSteadied_rad) +
                           kCommon_rad * kCommon_rad;
  wall.covariance(1, 1) += kCommon_m * kCommon_m;
  wall.begin_m = fit.begin_m;
  wall.end_m = fit.end_m;
  const double span_m = fit.end_m - fit.begin_m;
  wall.is_conservatively_straight = span_m * span_m > 8.0 * kCurved_m * fit.nearest_m;
  return wall;
}

}  // namespace cairn::odometry_compass
