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

std::string start_fault(const Pose2& T_map_start, const RobotModel& robot, const World& world, const Traffic& traffic) {
  std::optional<std::string> why = not_free(T_map_start, robot, world);
  if (const auto mover = traffic.blocker_at(T_map_start); !why && mover) {
    char place[80];
    std::snprintf(place, sizeof place, "(%.2f, %.2f) m: ", T_map_start.x_m, T_map_start.y_m);
    why = std::string(place) + "it would overlap " + *mover;
  }
  return why ? "the robot cannot start at " + *why : std::string();
}

double approached(double now, double wanted, double largest_change) {
  return now + std::clamp(wanted - now, -largest_change, largest_change);
}

}  // namespace

SimulatedRobot::SimulatedRobot(const SimulatedRobotConfig& config, const RobotModel& robot, const World* world,
                               const Pose2& T_map_start, std::uint64_t seed, double begin_s)
    : config_(config),
      robot_(robot),
      scene_(checked(world)),
      traffic_(*world, robot, T_map_start),
      body_(robot, scene_),
      firing_order_(checked_order(robot)),
      period_s_(robot.firing_period_s > 0.0 ? robot.firing_period_s : config.tick_s),
      fire_all_(config.fire_all || robot.firing_period_s <= 0.0),
      T_map_robot_(T_map_start),
      odometer_(robot.odometry_error, config.turn_as_distance_m_per_rad, seed),
      compass_(robot.compass_error, seed),
      range_noise_(seed, kRangePurpose),
      faults_(config.faults, config.random_faults, robot, *world, seed),
      witness_(robot),
      battery_ratio_(config.battery ? config.battery->start_ratio : 1.0) {
  catch_up(begin_s);
  fault_ = start_fault(T_map_start, robot, *world, traffic_);
  traffic_.show(traffic_.places(), scene_);
  witness_.note(static_cast<double>(ticks_) * period_s_, T_map_start, traffic_.places());
  for (const SonarModel& sonar : robot.sonars) echoes_.emplace_back(config.echo, scene_, sonar.half_beam_rad);
}

void SimulatedRobot::catch_up(double begin_s) {
  const auto ticks = static_cast<std::int64_t>(std::llround(begin_s / period_s_));
  if (ticks <= 0) return;
  for (ticks_ = traffic_.is_empty() ? ticks - 1 : 0; ticks_ < ticks;)
    traffic_.advance(static_cast<double>(++ticks_) * period_s_, period_s_, T_map_robot_);
  faults_.advance(static_cast<double>(ticks_) * period_s_);
  while (faults_.kidnap()) faults_.kidnapped();
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
  has_observed_ = true;
  step.state = SensorState::observation;
  Observation& seen = step.observation;
  seen.stamp_s = static_cast<double>(ticks_) * period_s_;
  seen.T_odom_robot = odometer_.T_odom_robot();
  if (config_.compass) seen.compass_rad = wrap_angle(compass_.read(T_map_robot_) + faults_.compass_jump_rad());
  seen.bumped = bumped_;
  if (config_.battery) seen.battery_ratio = battery_ratio_;
  if (fire_all_) {
    for (const int sonar : firing_order_) fire_into(seen.ranges, sonar);
  } else if (!firing_order_.empty()) {
    const auto turn = static_cast<std::size_t>(ticks_ - 1) % firing_order_.size();
    fire_into(seen.ranges, firing_order_[turn]);
  }
  return step;
}

std::optional<GroundTruth> SimulatedRobot::last_truth() const {
  if (!has_observed_) return std::nullopt;
  return GroundTruth{T_map_robot_, contact_};
}

Twist SimulatedRobot::towards_wanted() const {
  const Twist wanted = battery_ratio_ > 0.0 ? wanted_ : Twist{};
  Twist next;
  next.v_mps = approached(twist_.v_mps, std::clamp(wanted.v_mps, -robot_.max_v_mps, robot_.max_v_mps),
                          robot_.max_acceleration_mps2 * period_s_);
  next.w_radps = approached(twist_.w_radps, std::clamp(wanted.w_radps, -robot_.max_w_radps, robot_.max_w_radps),
                            robot_.max_turn_acceleration_radps2 * period_s_);
  if (robot_.kinematics == Kinematics::car && robot_.min_turning_radius_m > 0.0) {
    const double tightest_radps = std::abs(next.v_mps) / robot_.min_turning_radius_m;
    next.w_radps = std::clamp(next.w_radps, -tightest_radps, tightest_radps);
  }
  return next;
}

void SimulatedRobot::move() {
  ++ticks_;
  const double time_s = static_cast<double>(ticks_) * period_s_;
  faults_.advance(time_s);
  carry_off();
  if (!traffic_.is_empty()) {
    traffic_.advance(time_s, period_s_, T_map_robot_);
    traffic_.show(traffic_.places(), scene_);
  }
  const Twist next = towards_wanted();
  // The mean of both ends is the exact way under constant acceleration.
  const Twist turned{0.5 * (twist_.v_mps + next.v_mps), 0.5 * (twist_.w_radps + next.w_radps)};
  const std::optional<Twist> slipping = faults_.slipping(turned);
  const Twist going = slipping.value_or(turned);
  const Pose2 T_map_before = T_map_robot_;
  const Move move = body_.drive(T_map_robot_, going.v_mps * period_s_, going.w_radps * period_s_);
  twist_ = next;
  if (move.touched) twist_.v_mps = 0.0;
  note_touch(move, T_map_before, going);
  // Wheels that slip turn on whatever they stand against.
  odometer_.add(slipping ? Move{turned.v_mps * period_s_, turned.w_radps * period_s_} : move);
  witness_.note(time_s, T_map_robot_, traffic_.places());
  use_battery();
}

// Where a mover or a closed door is in the way, it is put down later.
void SimulatedRobot::carry_off() {
  const std::optional<KidnapConfig> kidnap = faults_.kidnap();
  if (!kidnap) return;
  const Pose2 T_map_put{kidnap->to_m.x(), kidnap->to_m.y(),
                        wrap_angle(kidnap->angle_rad.value_or(T_map_robot_.theta_rad))};
  if (traffic_.blocker_at(T_map_put)) return;
  T_map_robot_ = T_map_put;
  faults_.kidnapped();
  witness_.forget();
}

void SimulatedRobot::note_touch(const Move& move, const Pose2& T_map_before, const Twist& going) {
  contact_.reset();
  const bool touches = move.touched || traffic_.touches_robot();
  if (touches && !bumped_) {
    ++collisions_;
    contact_ = witness_.judge(body_, scene_, traffic_, move.touched ? move.T_map_touch : T_map_before, going);
  }
  bumped_ = touches;
}

void SimulatedRobot::use_battery() {
  if (!config_.battery) return;
  const BatteryConfig& battery = *config_.battery;
  const double speed_ratio = std::min(1.0, std::abs(twist_.v_mps) / robot_.max_v_mps);
  const double used_per_s =
      1.0 / battery.standing_s + speed_ratio * std::max(0.0, 1.0 / battery.driving_s - 1.0 / battery.standing_s);
  battery_ratio_ = std::max(0.0, battery_ratio_ - used_per_s * period_s_);
}

// A reading that is not told is taken all the same, so that those that follow are what they would have been.
void SimulatedRobot::fire_into(std::vector<RangeReading>& ranges, int sonar) {
  if (const std::optional<RangeReading> reading = faults_.reported(fire(sonar))) ranges.push_back(*reading);
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
