// What is under a Pioneer's microcontroller: wheels and sonars.
#pragma once

#include <cmath>

#include "maps/geometry/pose.hpp"

namespace cairn::p2os_robot {

class PioneerBody {
 public:
  virtual ~PioneerBody() = default;
  // Turns the wheels so for that time.
  virtual void drive(const Twist& twist, double dt_s) = 0;
  // By the wheels, from where it began.
  [[nodiscard]] virtual Pose2 odometry() const = 0;
  [[nodiscard]] virtual int sonars() const = 0;
  // Infinite where it hears nothing.
  [[nodiscard]] virtual double range_m(int sonar) = 0;
  [[nodiscard]] virtual bool is_bumped() const { return false; }
};

// Wheels that obey at once; one sonar, which hears something one metre away.
class FreeBody : public PioneerBody {
 public:
  void drive(const Twist& twist, double dt_s) override {
    pose_.theta_rad += twist.w_radps * dt_s;
    pose_.x_m += twist.v_mps * dt_s * std::cos(pose_.theta_rad);
    pose_.y_m += twist.v_mps * dt_s * std::sin(pose_.theta_rad);
  }
  [[nodiscard]] Pose2 odometry() const override { return pose_; }
  [[nodiscard]] int sonars() const override { return 1; }
  [[nodiscard]] double range_m(int /*sonar*/) override { return 1.0; }

 private:
  Pose2 pose_;
};

}  // namespace cairn::p2os_robot
