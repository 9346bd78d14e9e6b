// The drive of docs/write-a-sensor.md.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/sensor.hpp"

namespace wheels {

// What the motor board reads; a real board has a format of its own.
struct Packet {
  double v_mps = 0.0;
  double w_radps = 0.0;
  double valid_for_s = 0.0;  // the board stops the wheels by itself when this time has passed
};

// The wheels behind a motor board. The line is open for writing and does not block.
class Wheels : public cairn::Drive {
 public:
  Wheels(int line, const cairn::RobotModel& robot)
      : line_(line), max_v_mps_(robot.max_v_mps), max_w_radps_(robot.max_w_radps) {}

  void command(const cairn::Twist& twist, double valid_for_s) override {
    if (!cairn::is_finite(twist)) throw std::invalid_argument("wheels: the velocity is not finite");
    const double v_mps = std::clamp(twist.v_mps, -max_v_mps_, max_v_mps_);
    const double w_radps = std::clamp(twist.w_radps, -max_w_radps_, max_w_radps_);
    if (!send({v_mps, w_radps, valid_for_s})) throw std::runtime_error("wheels: the motor board takes no command");
  }

  void stop() noexcept override { (void)send({}); }

 private:
  // One system call: no lock, no allocation, allowed in a signal handler.
  [[nodiscard]] bool send(const Packet& packet) const noexcept {
    return ::write(line_, &packet, sizeof packet) == static_cast<ssize_t>(sizeof packet);
  }

  int line_;
  double max_v_mps_;
  double max_w_radps_;
};

}  // namespace wheels
