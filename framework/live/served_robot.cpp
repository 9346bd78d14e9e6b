#include "framework/live/served_robot.hpp"

#include <stdexcept>
#include <utility>

#include "framework/live/wire.hpp"

namespace cairn::live {

ServedRobot::ServedRobot(std::shared_ptr<Sensor> robot, const RobotModel& model)
    : robot_(std::move(robot)), model_(model) {
  if (robot_->drive() == nullptr)
    throw std::runtime_error("the mission's sensor cannot be driven: a base needs wheels");
}

std::string ServedRobot::take(const std::string& line) {
  try {
    const ClientLine message = client_line(line);
    if (message.kind == ClientLine::Kind::command) {
      robot_->drive()->command(message.twist, message.valid_for_s);
      orders_.order(message.twist, message.valid_for_s, stamp_s_);
    }
    if (message.kind == ClientLine::Kind::stop) stop();
    is_asked_ = is_asked_ || message.kind == ClientLine::Kind::next;
    return {};
  } catch (const std::exception& error) {
    stop();
    return "{\"refused\":" + fault_line(error.what()).substr(sizeof "{\"fault\":" - 1);
  }
}

void ServedRobot::stop() {
  robot_->drive()->stop();
  orders_.stop();
}

bool ServedRobot::take_request() {
  return std::exchange(is_asked_, false);
}

ServedRobot::Tick ServedRobot::tick() {
  const SensorStep step = robot_->next(Budget{});
  if (step.state != SensorState::observation) return {fault_line(step.reason), step.reason, stamp_s_, {}, {}};
  Tick tick{line_of(step.observation, model_), {}, step.observation.stamp_s, orders_.ordered(stamp_s_ + 1e-9), {}};
  tick.driven = driven(tick.stamp_s);
  const auto* truth = robot_->truth();
  const auto here = truth == nullptr ? std::nullopt : truth->last_truth();
  T_map_robot_ = here ? std::optional(here->T_map_robot) : std::nullopt;
  stamp_s_ = tick.stamp_s;
  return tick;
}

std::optional<Twist> ServedRobot::driven(double stamp_s) const {
  const auto* truth = robot_->truth();
  const auto here = truth == nullptr ? std::nullopt : truth->last_truth();
  if (!here || !T_map_robot_ || !(stamp_s > stamp_s_)) return std::nullopt;
  const Pose2 moved = inverse(*T_map_robot_) * here->T_map_robot;
  const double for_s = stamp_s - stamp_s_;
  return Twist{std::copysign(moved.position().norm(), moved.x_m) / for_s, moved.theta_rad / for_s};
}

}  // namespace cairn::live
