// Where velocities are sent to.
#pragma once

#include <atomic>

#include "maps/geometry/pose.hpp"
#include "plugins/ros2_robot/config.hpp"
#include "plugins/ros2_robot/dds/endpoints.hpp"

namespace cairn::ros2_robot {

class VelocityTopic {
 public:
  // Throws std::runtime_error.
  VelocityTopic(const Participant& participant, const CommandTopic& topic);

  // Velocities are of the type that who listens wants: of both where both are. At most twice a second.
  void look_who_listens(double now_s);
  // Who listens may be met from now on.
  void meet(double now_s) { heard_s_ = now_s; }
  // Whether somebody listened lately, or might still be met.
  [[nodiscard]] bool is_heard(double now_s) const { return now_s - heard_s_ < kMeetWithin_s; }
  // Beside look_who_listens(), by another thread. base_ahead_s: of the base's clock to this computer's steady one,
  // since a base may refuse velocities with other stamps; 0: not known.
  void send(const Twist& twist, double base_ahead_s) noexcept;
  // Empty: it sends none of that type.
  [[nodiscard]] const Entity& twist() const { return twist_; }
  [[nodiscard]] const Entity& twist_stamped() const { return twist_stamped_; }

 private:
  static constexpr double kMeetWithin_s = 3.0;

  std::string frame_;
  Entity twist_;
  Entity twist_stamped_;
  double looked_s_ = 0.0;
  double heard_s_ = 0.0;
  std::atomic<bool> sends_twist_{false};
  std::atomic<bool> sends_stamped_{false};
};

}  // namespace cairn::ros2_robot
