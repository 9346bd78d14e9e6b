#include "plugins/simulated_robot/simulated_robot.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace cairn {
namespace {

const World& checked(const World* world) {
  if (world == nullptr) {
    throw std::invalid_argument(
        "simulated_robot needs a world (`world: FILE` in the mission); a log sensor needs none");
  }
  return *world;
}

double period_of(const SimulatedRobotConfig& config, const RobotModel& robot) {
  if (robot.sonars.empty() && !robot.lasers.empty()) return laser_tick_s(robot, config.tick_s);
  return robot.firing_period_s > 0.0 ? robot.firing_period_s : config.tick_s;
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

}  // namespace

SimulatedRobot::SimulatedRobot(const SimulatedRobotConfig& config, const RobotModel& robot, const World* world,
                               const Pose2& T_map_start, std::uint64_t seed, double begin_s, bool wants_images)
    : period_s_(period_of(config, robot)),
      scene_(checked(world)),
      traffic_(*world, robot, T_map_start),
      body_(robot, scene_),
      motors_(robot, config.emergency_braking_ratio),
      battery_(config.battery),
      odometer_(in_truth(robot, config.truth).odometry_error, config.turn_as_distance_m_per_rad, seed),
      sonars_(config, robot, scene_, seed),
      lasers_(robot, scene_, seed),
      faults_(config.faults, config.random_faults, robot, *world, seed),
      witness_(robot),
      T_map_robot_(T_map_start) {
  if (config.compass && robot.has_compass) compass_.emplace(in_truth(robot, config.truth).compass_error, seed);
  if (wants_images) cameras_.emplace(robot, *world, scene_, seed);
  catch_up(begin_s);
  start_fault_ = start_fault(T_map_start, robot, *world, traffic_);
  traffic_.show(traffic_.places(), scene_);
  witness_.note(time_s(), T_map_start, traffic_.places());
}

void SimulatedRobot::catch_up(double begin_s) {
  const auto ticks = static_cast<std::int64_t>(std::llround(begin_s / period_s_));
  if (ticks <= 0) return;
  for (ticks_ = traffic_.is_empty() ? ticks - 1 : 0; ticks_ < ticks;)
    traffic_.advance(static_cast<double>(++ticks_) * period_s_, period_s_, T_map_robot_);
  faults_.advance(time_s());
  while (faults_.kidnap()) faults_.kidnapped();
}

SensorStep SimulatedRobot::next(const Budget&) {
  SensorStep step;
  if (!start_fault_.empty()) {
    step.state = SensorState::fault;
    step.reason = start_fault_;
    return step;
  }
  const std::optional<Contact> contact = move();
  truth_ = GroundTruth{T_map_robot_, contact};
  step.state = SensorState::observation;
  Observation& seen = step.observation;
  seen.stamp_s = time_s();
  seen.T_odom_robot = odometer_.T_odom_robot();
  if (compass_) seen.compass_rad = wrap_angle(compass_->read(T_map_robot_) + faults_.compass_jump_rad());
  seen.bumped = bumped_;
  seen.battery_ratio = battery_.reading();
  // All are fired, so that a reading that is not reported does not change those that follow.
  for (const RangeReading& reading : sonars_.fire(T_map_robot_, ticks_))
    if (const std::optional<RangeReading> reported = faults_.reported(reading)) seen.ranges.push_back(*reported);
  scanned_.clear();
  lasers_.scan(T_map_robot_, time_s() - period_s_, time_s(), scanned_);
  if (!faults_.is_silent()) seen.ranges.insert(seen.ranges.end(), scanned_.begin(), scanned_.end());
  if (cameras_) cameras_->take(T_map_robot_, time_s() - period_s_, time_s(), seen.images);
  return step;
}

// The contact that it begins.
std::optional<Contact> SimulatedRobot::move() {
  ++ticks_;
  faults_.advance(time_s());
  carry_off();
  if (!traffic_.is_empty()) {
    traffic_.advance(time_s(), period_s_, T_map_robot_);
    traffic_.show(traffic_.places(), scene_);
  }
  const Twist turned = motors_.turn(period_s_, !battery_.is_empty());
  const std::optional<Twist> slipping = faults_.slipping(turned);
  const Twist going = slipping.value_or(turned);
  const Pose2 T_map_before = T_map_robot_;
  const Move move = body_.drive(T_map_robot_, going.v_mps * period_s_, going.w_radps * period_s_);
  if (move.touched) motors_.stop_driving();
  const std::optional<Contact> contact = touch(move, T_map_before, going);
  // Wheels that slip turn on whatever they stand against.
  odometer_.add(slipping ? Move{turned.v_mps * period_s_, turned.w_radps * period_s_} : move);
  witness_.note(time_s(), T_map_robot_, traffic_.places());
  battery_.drain(motors_.speed_ratio(), period_s_);
  return contact;
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

std::optional<Contact> SimulatedRobot::touch(const Move& move, const Pose2& T_map_before, const Twist& going) {
  const bool was_bumped = bumped_;
  bumped_ = move.touched || traffic_.touches_robot();
  if (!bumped_ || was_bumped) return std::nullopt;
  ++collisions_;
  return witness_.judge(body_, scene_, traffic_, move.touched ? move.T_map_touch : T_map_before, going);
}

}  // namespace cairn
