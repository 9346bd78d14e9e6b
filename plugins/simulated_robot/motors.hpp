// The robot's motors: they bring the wheels to the commanded velocity within the robot's limits.
#pragma once

#include <atomic>
#include <cmath>

#include "framework/contracts/robot_model.hpp"

namespace cairn {

class Motors {
 public:
  // emergency_ratio: so much harder they brake when no command counts.
  explicit Motors(const RobotModel& robot, double emergency_ratio = 1.0)
      : robot_(robot), emergency_ratio_(emergency_ratio) {}

  // For so long at most. Throws std::invalid_argument when not finite.
  void command(const Twist& twist, double valid_for_s);
  // Until the next command. From any thread. The first turn after a command is made all the same: no simulated time has
  // passed between the two, and a mission must not depend on how fast the machine was in between.
  void stop() noexcept { is_stopped_.store(true, std::memory_order_relaxed); }
  // How the wheels turn for a time, on the mean; without power or a command that counts they brake,
  // and in an emergency (no command that counts) as hard as they can.
  [[nodiscard]] Twist turn(double for_s, bool has_power);
  // Something stands in the way.
  void stop_driving() { twist_.v_mps = 0.0; }
  // At the end of the last turn.
  [[nodiscard]] const Twist& twist() const { return twist_; }
  // Of the robot's top speed.
  [[nodiscard]] double speed_ratio() const { return std::abs(twist_.v_mps) / robot_.max_v_mps; }

 private:
  RobotModel robot_;
  double emergency_ratio_;
  Twist wanted_;
  double valid_for_s_ = 0.0;              // from now on
  bool is_new_command_ = false;           // no turn has been made since
  std::atomic<bool> is_stopped_ = false;  // since the last command
  Twist twist_;
};

}  // namespace cairn
