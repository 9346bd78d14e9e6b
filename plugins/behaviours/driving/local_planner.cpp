#include "plugins/behaviours/driving/local_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cairn::behaviours {
namespace {

// The window: what can be reached within this time, which is about how long a chosen arc is driven.
constexpr double kWindow_s = 0.4;
constexpr int kSpeeds = 5;
constexpr int kTurnRates = 15;
constexpr double kAhead_s = 1.0;       // an arc is judged by where it leads in this time
constexpr double kReaction_s = 0.3;    // about a round of the sonars
constexpr double kBraking = 0.8;       // of the robot's deceleration: the stop layer need not interfere
constexpr double kBeyond_m = 0.08;     // an arc is free when it is so far beyond the braking way
constexpr double kFarthest_m = 1.0;    // more free way is no better
constexpr double kSlowest_mps = 0.05;  // of a candidate
constexpr double kTight_m = 0.03;      // clearance where there is no more room,
constexpr double kTightSpeed_mps = 0.12;
// Weights of eq. 13.
constexpr double kHeading = 1.0;
constexpr double kClearance = 0.5;
constexpr double kSpeed = 0.25;
// Towards what the follower prefers: of two that are as good, the one nearer to the path.
constexpr double kPreference = 0.15;

// Within reach of an obstacle an arc may lead along it, but not nearer by more than this share of its first metres.
constexpr double kSoon_m = 0.05;
constexpr double kNearer = 0.3;

constexpr double kNear_m = 1.3;
constexpr double kGatherEvery_s = 0.2;
constexpr double kEchoCounts_s = 0.7;
constexpr double kBehind_m = 0.15;
constexpr double kExplained_m = 0.1;
constexpr double kSurelyInBeam = 0.6;       // of half a beam
constexpr double kThin_rad = radians(1.0);  // half a beam of no width
constexpr int kArcPoints = 5;
constexpr double kLongestTick_s = 0.5;

double braking_distance_m(double v_mps, const LocalLimits& limits) {
  return v_mps * v_mps / (2.0 * kBraking * limits.acceleration_mps2) + kReaction_s * v_mps;
}

Point arc_end(const Twist& twist, double time_s) {
  const double turn_rad = twist.w_radps * time_s;
  if (std::abs(turn_rad) < 1e-6) return {twist.v_mps * time_s, 0.0};
  const double radius_m = twist.v_mps / twist.w_radps;
  return {radius_m * std::sin(turn_rad), radius_m * (1.0 - std::cos(turn_rad))};
}

struct Window {
  double min_v_mps, max_v_mps, min_w_radps, max_w_radps;
};

Window window_about(const Twist& now, const LocalLimits& limits) {
  const double dv = limits.acceleration_mps2 * kWindow_s;
  const double dw = limits.turn_acceleration_radps2 * kWindow_s;
  return {std::max(kSlowest_mps, now.v_mps - dv), std::max(kSlowest_mps, std::min(limits.max_v_mps, now.v_mps + dv)),
          std::max(-limits.max_w_radps, now.w_radps - dw), std::min(limits.max_w_radps, now.w_radps + dw)};
}

bool can_steer(const Twist& twist, const LocalLimits& limits) {
  return limits.min_turning_radius_m <= 0.0 ||
         std::abs(twist.w_radps) * limits.min_turning_radius_m <= twist.v_mps + 1e-9;
}

double score(const Twist& twist, double way_m, const LocalWish& wish, const LocalLimits& limits) {
  const Point end = arc_end(twist, kAhead_s);
  const Point to_aim = wish.aim - end;
  const double facing_rad = twist.w_radps * kAhead_s;
  const double error_rad = to_aim.norm() < 0.05 ? 0.0 : wrap_angle(std::atan2(to_aim.y(), to_aim.x()) - facing_rad);
  const double heading = 1.0 - std::abs(error_rad) / std::numbers::pi;
  const double clearance = std::min(way_m, kFarthest_m) / kFarthest_m;
  const double difference = std::abs(twist.w_radps - wish.preferred.w_radps) / std::max(0.1, limits.max_w_radps);
  return kHeading * heading + kClearance * clearance + kSpeed * twist.v_mps / limits.max_v_mps -
         kPreference * difference;
}

LocalStep best_with(double clearance_m, double max_v_mps, const Twist& now, const LocalWish& wish,
                    const std::vector<Point>& obstacles, const LocalLimits& limits) {
  const double reach_m = limits.radius_m + clearance_m;
  const double to_aim_m = wish.aim.norm();
  const auto is_free = [&](const Twist& twist, double way_m) {
    return way_m >= std::min(braking_distance_m(twist.v_mps, limits) + kBeyond_m, std::max(to_aim_m, 0.02));
  };
  const double share = std::min(1.0, max_v_mps / std::max(1e-9, wish.preferred.v_mps));
  const Twist preferred{share * wish.preferred.v_mps, share * wish.preferred.w_radps};
  if (is_free(preferred, free_distance_m(preferred, obstacles, reach_m))) return {preferred, false};

  const Window window = window_about(now, limits);
  LocalStep best{{}, true};
  double best_score = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSpeeds; ++i) {
    const double fastest = std::min({window.max_v_mps, max_v_mps, std::max(wish.preferred.v_mps, kSlowest_mps)});
    const double slowest = std::min(window.min_v_mps, fastest);
    const double v_mps = slowest + (fastest - slowest) * i / (kSpeeds - 1);
    for (int k = 0; k < kTurnRates; ++k) {
      const double w_radps = window.min_w_radps + (window.max_w_radps - window.min_w_radps) * k / (kTurnRates - 1);
      const Twist twist{v_mps, w_radps};
      if (!can_steer(twist, limits)) continue;
      const double way_m = free_distance_m(twist, obstacles, reach_m);
      if (way_m < braking_distance_m(v_mps, limits)) continue;
      const double value = score(twist, way_m, wish, limits);
      if (value <= best_score) continue;
      best_score = value;
      best = {twist, false};
    }
  }
  return best;
}

}  // namespace

LocalLimits local_limits(const RobotModel& robot, double speed_mps) {
  LocalLimits limits;
  limits.max_v_mps = std::min(speed_mps, robot.max_v_mps);
  limits.max_w_radps = std::min(radians(50.0), robot.max_w_radps);
  limits.acceleration_mps2 = robot.max_acceleration_mps2;
  limits.turn_acceleration_radps2 = robot.max_turn_acceleration_radps2;
  if (robot.kinematics == Kinematics::car) limits.min_turning_radius_m = robot.min_turning_radius_m;
  limits.radius_m = robot.radius_m;
  return limits;
}

double free_distance_m(const Twist& twist, const std::vector<Point>& obstacles, double reach_m) {
  const double sign = twist.v_mps < 0.0 ? -1.0 : 1.0;
  const double curvature = twist.w_radps / twist.v_mps;
  const Point soon = arc_end(twist, kSoon_m / std::abs(twist.v_mps));
  double way_m = std::numeric_limits<double>::infinity();
  for (const Point& p : obstacles) {
    const double distance2 = p.squaredNorm();
    if (distance2 < reach_m * reach_m) {
      if ((p - soon).norm() < std::sqrt(distance2) - kNearer * kSoon_m) return 0.0;
      continue;
    }
    if (std::abs(curvature) < 1e-3) {
      const double ahead_m = sign * p.x();
      if (ahead_m <= 0.0 || std::abs(p.y()) >= reach_m) continue;
      way_m = std::min(way_m, ahead_m - std::sqrt(reach_m * reach_m - p.y() * p.y()));
      continue;
    }
    // The robot goes round (0, 1 / curvature); where its circle meets the one about the obstacle.
    const double radius_m = 1.0 / std::abs(curvature);
    const Point q(sign * p.x(), curvature > 0.0 ? p.y() : -p.y());  // mirrored: forward and to the left
    const Point from_centre = q - Point(0.0, radius_m);
    const double d_m = from_centre.norm();
    if (d_m < 1e-9 || d_m >= radius_m + reach_m || d_m <= radius_m - reach_m) continue;
    const double cosine = (radius_m * radius_m + d_m * d_m - reach_m * reach_m) / (2.0 * radius_m * d_m);
    double angle_rad = std::atan2(from_centre.x(), -from_centre.y()) - std::acos(std::clamp(cosine, -1.0, 1.0));
    if (angle_rad < 0.0) angle_rad += 2.0 * std::numbers::pi;
    way_m = std::min(way_m, radius_m * angle_rad);
  }
  return way_m;
}

LocalStep best_in_window(const Twist& now, const LocalWish& wish, const std::vector<Point>& obstacles,
                         const LocalLimits& limits) {
  // A disc that turns in place sweeps nothing new.
  if (wish.preferred.v_mps == 0.0) return {wish.preferred, false};
  const LocalStep step = best_with(limits.clearance_m, limits.max_v_mps, now, wish, obstacles, limits);
  if (!step.blocked) return step;
  return best_with(std::min(kTight_m, limits.clearance_m), kTightSpeed_mps, now, wish, obstacles, limits);
}

Twist approached(const Twist& now, const Twist& target, double passed_s, const LocalLimits& limits) {
  const auto towards = [](double from, double to, double most) { return from + std::clamp(to - from, -most, most); };
  Twist next{towards(now.v_mps, target.v_mps, limits.acceleration_mps2 * passed_s),
             towards(now.w_radps, target.w_radps, limits.turn_acceleration_radps2 * passed_s)};
  if (limits.min_turning_radius_m > 0.0) {
    const double max_radps = std::abs(next.v_mps) / limits.min_turning_radius_m;
    next.w_radps = std::clamp(next.w_radps, -max_radps, max_radps);
  }
  return next;
}

void LocalPlanner::gather_cells(const WorldView& world, const NearEchoes& near_echoes, const CellSet& doubted) {
  gathered_s_ = world.time_s;
  cells_map_.clear();
  const OccupancyGrid& grid = world.grid;
  const Cell centre = grid.cell_at(world.pose.T_map_robot.position());
  const int reach = static_cast<int>(std::ceil(kNear_m / grid.cell_m()));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      if (dx * dx + dy * dy > reach * reach) continue;
      const Cell c = centre + Cell{dx, dy};
      if (near_echoes.is_occupied(grid, c) && !doubted.contains(c)) cells_map_.push_back(grid.centre_of(c));
    }
  }
}

void LocalPlanner::add(const RangeReading& reading, const WorldView& world) {
  if (reading.sensor < 0 || reading.sensor >= kMaxSensors || std::isnan(reading.range_m)) return;
  const auto index = static_cast<std::size_t>(reading.sensor);
  if (index >= echoes_.size()) echoes_.resize(index + 1);
  Echo& echo = echoes_[index];
  const double range_m = std::max(reading.range_m, reading.min_m);
  const Pose2 T_map_sensor = world.pose.T_map_robot * reading.T_robot_sensor;
  echo = {world.time_s, range_m, reading.half_beam_rad, T_map_sensor, {}};
  if (range_m > kNear_m) return;
  const int count = reading.half_beam_rad > 0.0 ? kArcPoints : 1;
  for (int i = 0; i < count; ++i) {
    const double bearing_rad = count == 1 ? 0.0 : reading.half_beam_rad * (2.0 * i / (count - 1) - 1.0);
    echo.points_map.push_back(T_map_sensor * Point(range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad)));
  }
}

// An echo from behind a place says that nothing is there now; silence does not, for a mirror is silent too.
LocalPlanner::Live LocalPlanner::live_echo_at(const Point& p_map, double time_s) const {
  Live live = Live::silent;
  for (const Echo& echo : echoes_) {
    if (time_s - echo.stamp_s > kEchoCounts_s || !std::isfinite(echo.range_m)) continue;
    const Point to = p_map - echo.T_map_sensor.position();
    const double behind_m = echo.range_m - to.norm();
    const double off_rad = wrap_angle(std::atan2(to.y(), to.x()) - echo.T_map_sensor.theta_rad);
    if (std::abs(off_rad) > std::max(kThin_rad, kSurelyInBeam * echo.half_beam_rad) || behind_m < -kBehind_m) continue;
    if (behind_m >= kBehind_m) return Live::seen_through;
    live = Live::there;
  }
  return live;
}

// By something known in its beam at its range: then the echo came from there, and not from all of its arc. With all of
// the arcs that its posts echo on, a narrow door would be closed.
bool LocalPlanner::is_explained(const Echo& echo, const std::vector<Point>& there_map) {
  return std::ranges::any_of(there_map, [&](const Point& p) {
    const Point to = p - echo.T_map_sensor.position();
    const double off_rad = wrap_angle(std::atan2(to.y(), to.x()) - echo.T_map_sensor.theta_rad);
    return std::abs(to.norm() - echo.range_m) <= kExplained_m && std::abs(off_rad) <= echo.half_beam_rad;
  });
}

void LocalPlanner::see(const WorldView& world, const NearEchoes& near_echoes, const CellSet& doubted) {
  passed_s_ = std::clamp(world.time_s - last_s_, 0.0, kLongestTick_s);
  last_s_ = world.time_s;
  if (world.time_s - gathered_s_ >= kGatherEvery_s) gather_cells(world, near_echoes, doubted);
  if (world.observation != nullptr)
    for (const RangeReading& reading : world.observation->ranges) add(reading, world);
  std::vector<Point> there_map;
  for (const Point& p : cells_map_)
    if (live_echo_at(p, world.time_s) != Live::seen_through) there_map.push_back(p);
  obstacles_.clear();
  const Pose2 T_robot_map = inverse(world.pose.T_map_robot);
  for (const Point& p : there_map) obstacles_.push_back(T_robot_map * p);
  for (const Echo& echo : echoes_) {
    if (world.time_s - echo.stamp_s > kEchoCounts_s || echo.points_map.empty() || is_explained(echo, there_map))
      continue;
    for (const Point& p : echo.points_map) obstacles_.push_back(T_robot_map * p);
  }
}

// What was ordered, less what the stop layer has taken away.
Twist LocalPlanner::now(const WorldView& world) const {
  const double share = 1.0 - std::clamp(world.speed_reduction_ratio, 0.0, 1.0);
  return {share * last_ordered_.v_mps, last_ordered_.w_radps};
}

Twist LocalPlanner::steer(const Twist& preferred, const Point& aim_map, double speed_mps, const WorldView& world) {
  const LocalLimits limits = local_limits(world.robot, speed_mps);
  const LocalWish wish{preferred, inverse(world.pose.T_map_robot) * aim_map};
  const LocalStep step = best_in_window(now(world), wish, obstacles_, limits);
  blocked_ = step.blocked;
  last_ordered_ = approached(now(world), step.target, passed_s_, limits);
  return last_ordered_;
}

Twist LocalPlanner::approach(const Twist& target, const WorldView& world) {
  blocked_ = false;
  last_ordered_ = approached(now(world), target, passed_s_, local_limits(world.robot, world.robot.max_v_mps));
  return last_ordered_;
}

}  // namespace cairn::behaviours
