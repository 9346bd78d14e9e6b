// The robot's motors: they bring the wheels to the commanded velocity within the robot's limits.
#pragma once

#include <cmath>

#include "framework/contracts/robot_model.hpp"

namespace cairn {

class Motors {
 public:
  explicit Motors(const RobotModel& robot) : robot_(robot) {}

  // Throws std::invalid_argument when not finite.
  void command(const Twist& twist);
  // How the wheels turn for a time, on the mean; without power they brake.
  [[nodiscard]] Twist turn(double for_s, bool has_power);
  // Something stands in the way.
  void stop_driving() { twist_.v_mps = 0.0; }
  // At the end of the last turn.
  [[nodiscard]] const Twist& twist() const { return twist_; }
  // Of the robot's top speed.
  [[nodiscard]] double speed_ratio() const { return std::abs(twist_.v_mps) / robot_.max_v_mps; }

 private:
  RobotModel robot_;
  Twist wanted_;
  Twist twist_;
};

}  // namespace cairn
