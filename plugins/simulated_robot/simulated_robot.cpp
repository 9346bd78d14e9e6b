#include "plugins/simulated_robot/simulated_robot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>

namespace cairn {
namespace {

constexpr std::uint64_t kRangePurpose = 100;

const World& checked(const World* world) {
  if (world == nullptr) {
    throw std::invalid_argument(
        "simulated_robot needs a world (`world: FILE` in the mission); a log sensor needs none");
  }
  return *world;
}

std::vector<int> checked_order(const RobotModel& robot) {
  const int count = static_cast<int>(robot.sonars.size());
  std::vector<int> order = robot.firing_order;
  if (order.empty()) {
    order.resize(robot.sonars.size());
    std::iota(order.begin(), order.end(), 0);
  }
  for (const int sonar : order) {
    if (sonar < 0 || sonar >= count) {
      throw std::invalid_argument("simulated_robot: firing order names sonar " + std::to_string(sonar) + " of " +
                                  std::to_string(count));
    }
  }
  return order;
}

std::string start_fault(const Pose2& T_map_start, const RobotModel& robot, const World& world) {
  char place[80];
  std::snprintf(place, sizeof place, "(%.2f, %.2f) m", T_map_start.x_m, T_map_start.y_m);
  // A world without an extent is an open field.
  const bool bounded = (world.max_m.array() > world.min_m.array()).all();
  const Point at_m = T_map_start.position();
  if (bounded && ((at_m.array() < world.min_m.array()).any() || (at_m.array() > world.max_m.array()).any()))
    return std::string("the robot cannot start at ") + place + ": it lies outside the world's bounds_m";
  const std::optional<std::string> blocker = blocker_at(T_map_start, robot, world);
  if (!blocker) return {};
  return std::string("the robot cannot start at ") + place + ": it would overlap " + *blocker;
}

double approached(double now, double wanted, double largest_change) {
  return now + std::clamp(wanted - now, -largest_change, largest_change);
}

}  // namespace

SimulatedRobot::SimulatedRobot(const SimulatedRobotConfig& config, const RobotModel& robot, const World* world,
                               const Pose2& T_map_start, std::uint64_t seed)
    : config_(config),
      robot_(robot),
      scene_(checked(world)),
      body_(robot, scene_),
      firing_order_(checked_order(robot)),
      period_s_(robot.firing_period_s > 0.0 ? robot.firing_period_s : config.tick_s),
      fire_all_(config.fire_all || robot.firing_period_s <= 0.0),
      fault_(start_fault(T_map_start, robot, *world)),
      T_map_robot_(T_map_start),
      odometer_(robot.odometry_error, config.turn_as_distance_m_per_rad, seed),
      compass_(robot.compass_error, seed),
      range_noise_(seed, kRangePurpose) {
  for (const SonarModel& sonar : robot.sonars) echoes_.emplace_back(config.echo, scene_, sonar.half_beam_rad);
}

void SimulatedRobot::command(const Twist& twist) {
  if (!std::isfinite(twist.v_mps) || !std::isfinite(twist.w_radps)) {
    throw std::invalid_argument("simulated_robot: command is not finite: v " + std::to_string(twist.v_mps) +
                                " m/s, w " + std::to_string(twist.w_radps) + " rad/s");
  }
  wanted_ = twist;
}

SensorStep SimulatedRobot::next(const Budget&) {
  SensorStep step;
  if (!fault_.empty()) {
    step.state = SensorState::fault;
    step.reason = fault_;
    return step;
  }
  move();
  step.state = SensorState::observation;
  Observation& seen = step.observation;
  seen.stamp_s = static_cast<double>(ticks_) * period_s_;
  seen.T_odom_robot = odometer_.T_odom_robot();
  if (config_.compass) seen.compass_rad = compass_.read(T_map_robot_);
  seen.bumped = bumped_;
  seen.true_T_map_robot = T_map_robot_;
  if (fire_all_) {
    for (const int sonar : firing_order_) seen.ranges.push_back(fire(sonar));
  } else if (!firing_order_.empty()) {
    const auto turn = static_cast<std::size_t>(ticks_ - 1) % firing_order_.size();
    seen.ranges.push_back(fire(firing_order_[turn]));
  }
  return step;
}

Twist SimulatedRobot::towards_wanted() const {
  Twist next;
  next.v_mps = approached(twist_.v_mps, std::clamp(wanted_.v_mps, -robot_.max_v_mps, robot_.max_v_mps),
                          robot_.max_acceleration_mps2 * period_s_);
  next.w_radps = approached(twist_.w_radps, std::clamp(wanted_.w_radps, -robot_.max_w_radps, robot_.max_w_radps),
                            robot_.max_turn_acceleration_radps2 * period_s_);
  if (robot_.kinematics == Kinematics::car && robot_.min_turning_radius_m > 0.0) {
    const double tightest_radps = std::abs(next.v_mps) / robot_.min_turning_radius_m;
    next.w_radps = std::clamp(next.w_radps, -tightest_radps, tightest_radps);
  }
  return next;
}

void SimulatedRobot::move() {
  ++ticks_;
  const Twist next = towards_wanted();
  // The mean of both ends is the exact way under constant acceleration.
  const Move move = body_.drive(T_map_robot_, 0.5 * (twist_.v_mps + next.v_mps) * period_s_,
                                0.5 * (twist_.w_radps + next.w_radps) * period_s_);
  twist_ = next;
  if (move.touched) twist_.v_mps = 0.0;
  if (move.touched && !bumped_) ++collisions_;
  bumped_ = move.touched;
  odometer_.add(move);
}

RangeReading SimulatedRobot::fire(int sonar) {
  const SonarModel& model = robot_.sonars[static_cast<std::size_t>(sonar)];
  const RangeError& error = robot_.range_error;
  RangeReading reading{model.T_robot_sonar, model.half_beam_rad, model.min_m, model.max_m, 0.0, sonar};
  const std::optional<double> echo_m =
      echoes_[static_cast<std::size_t>(sonar)].first_echo(T_map_robot_ * model.T_robot_sonar, model.max_m);
  // As many draws for every reading, so that one lost echo does not change those that follow.
  const double noise = range_noise_.normal();
  const bool dropped = range_noise_.uniform() < error.dropped_ratio;
  const bool crosstalk = range_noise_.uniform() < error.crosstalk_ratio;
  const double elsewhere_m = model.min_m + range_noise_.uniform() * (model.max_m - model.min_m);
  constexpr double kNoEcho = std::numeric_limits<double>::infinity();
  double range_m = echo_m && !dropped ? *echo_m + (error.noise_m + error.noise_ratio * *echo_m) * noise : kNoEcho;
  if (crosstalk) range_m = elsewhere_m;
  reading.range_m = range_m < model.min_m ? -kNoEcho : range_m > model.max_m ? kNoEcho : range_m;
  return reading;
}

}  // namespace cairn
