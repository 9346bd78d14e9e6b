#include "framework/mission/localisation/pose_doubt.hpp"

#include <algorithm>
#include <cmath>

#include "framework/mission/localisation/self_finder.hpp"

namespace cairn {
namespace {

constexpr double kSlack_m = 0.25;      // by which pose and map may be off
constexpr double kHalfWidth_m = 0.15;  // of a ray, beside its end
constexpr double kStep_m = 0.1;
constexpr double kMaxRange_m = 4.0;  // what wide beams say of farther places is little
constexpr double kBeforeEcho_m = 0.4;

bool is_apart(const Pose2& a, const Pose2& b, double by_m, double by_rad) {
  const Pose2 off = inverse(a) * b;
  return off.position().norm() >= by_m || std::abs(off.theta_rad) >= by_rad;
}

// Where the echo may come from: all of it free contradicts.
MapAnswer answer_at_end(const OccupancyGrid& map, const Pose2& T_map_sensor, const RangeReading& reading) {
  const double half_rad = std::max(reading.half_beam_rad, std::atan2(kHalfWidth_m, reading.range_m));
  const int across = std::max(1, static_cast<int>(std::ceil(reading.range_m * half_rad / kStep_m)));
  MapAnswer answer = MapAnswer::contradicts;
  for (double range_m = reading.range_m - kSlack_m; range_m <= reading.range_m + kSlack_m; range_m += map.cell_m())
    for (int i = -across; i <= across; ++i) {
      const double bearing_rad = half_rad * i / across;
      const Point at_m = T_map_sensor * Point(range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad));
      const CellState state = map.state(map.cell_at(at_m));
      if (state == CellState::occupied) return MapAnswer::agrees;
      if (state == CellState::unknown) answer = MapAnswer::unknown;
    }
  return answer;
}

// Whether something stands on the axis before the echo.
bool is_behind_something(const OccupancyGrid& map, const Pose2& T_map_sensor, double range_m) {
  for (double at_m = kStep_m; at_m < range_m - kBeforeEcho_m; at_m += map.cell_m())
    if (map.state(map.cell_at(T_map_sensor * Point(at_m, 0.0))) == CellState::occupied) return true;
  return false;
}

}  // namespace

MapAnswer answer_of(const OccupancyGrid& map, const Pose2& T_map_robot, const RangeReading& reading) {
  const bool is_echo = reading.range_m >= reading.min_m && reading.range_m < std::min(reading.max_m, kMaxRange_m);
  if (!is_echo || !is_finite(reading.T_robot_sensor)) return MapAnswer::unknown;
  const Pose2 T_map_sensor = T_map_robot * reading.T_robot_sensor;
  if (is_behind_something(map, T_map_sensor, reading.range_m)) return MapAnswer::contradicts;
  return answer_at_end(map, T_map_sensor, reading);
}

PoseDoubt::PoseDoubt(const RobotModel& robot, const DoubtRules& rules)
    : rules_(rules),
      doubted_from_ratio_(rules.contradicted_ratio),
      compass_within_rad_(compass_within(robot)),
      has_compass_(robot.has_compass) {}

std::optional<DoubtCause> PoseDoubt::update(const Observation& observation, const Pose2& T_map_robot,
                                            const OccupancyGrid& before) {
  if (has_jumped(observation, T_map_robot) && !cause_) cause_ = DoubtCause::jump;
  compare(observation, T_map_robot, before);
  if (sum_.known >= rules_.min_readings && contradicted_ratio() >= doubted_from_ratio_ && !cause_)
    cause_ = DoubtCause::readings;
  if (!cause_ || !does_compass_agree(observation, T_map_robot)) return std::nullopt;
  return cause_;
}

double PoseDoubt::contradicted_ratio() const {
  return sum_.known < rules_.min_readings ? 0.0 : static_cast<double>(sum_.contradicted) / sum_.known;
}

void PoseDoubt::was_wrong() {
  doubted_from_ratio_ = std::min(rules_.max_contradicted_ratio, rules_.wrong_factor * doubted_from_ratio_);
}

void PoseDoubt::reset() {
  T_map_robot_.reset();
  T_odom_robot_.reset();
  pieces_.clear();
  sum_ = {};
  cause_.reset();
}

bool PoseDoubt::has_jumped(const Observation& observation, const Pose2& T_map_robot) {
  bool has_jumped = false;
  if (T_map_robot_) {
    const Pose2 by_odometry = inverse(*T_odom_robot_) * observation.T_odom_robot;
    has_jumped = is_apart(*T_map_robot_ * by_odometry, T_map_robot, rules_.jump_m, rules_.jump_rad);
  }
  T_map_robot_ = T_map_robot;
  T_odom_robot_ = observation.T_odom_robot;
  return has_jumped;
}

// A map of the robot's own that begins while a motor disturbs the compass bends when that ends.
bool PoseDoubt::does_compass_agree(const Observation& observation, const Pose2& T_map_robot) const {
  if (!has_compass_ || !observation.compass_rad) return true;
  return std::abs(wrap_angle(*observation.compass_rad - T_map_robot.theta_rad)) <= compass_within_rad_;
}

void PoseDoubt::compare(const Observation& observation, const Pose2& T_map_robot, const OccupancyGrid& before) {
  if (pieces_.empty() || is_apart(piece_begun_at_, T_map_robot, rules_.piece_m, rules_.piece_rad)) {
    pieces_.emplace_back();
    piece_begun_at_ = T_map_robot;
  }
  if (pieces_.size() > rules_.pieces) {
    sum_.known -= pieces_.front().known;
    sum_.contradicted -= pieces_.front().contradicted;
    pieces_.pop_front();
  }
  Piece& piece = pieces_.back();
  const std::size_t stride = 1 + observation.ranges.size() / (rules_.max_readings + 1);
  for (std::size_t i = 0; i < observation.ranges.size() && piece.readings < rules_.max_readings; i += stride) {
    const MapAnswer answer = answer_of(before, T_map_robot, observation.ranges[i]);
    const int known = answer != MapAnswer::unknown ? 1 : 0;
    const int contradicted = answer == MapAnswer::contradicts ? 1 : 0;
    ++piece.readings;
    piece.known += known;
    sum_.known += known;
    piece.contradicted += contradicted;
    sum_.contradicted += contradicted;
  }
}

}  // namespace cairn
