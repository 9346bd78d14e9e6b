// What makes one run of observations of what a live base gives: backlogs, clocks that step, bases that start again.
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"

namespace cairn::live {

inline constexpr double kMaxReadingAge_s = 1.0;

// Those that have come since the last tick as one: the last of them, with the readings of all that are no older than
// kMaxReadingAge_s then, each at the place on the robot from where it looks now. In order of time, at least one.
[[nodiscard]] Observation assembled(std::vector<Observation> observations);

// Stamps that never go back nor leap ahead, and odometry that goes on, whatever the base's clock does. A base's stamps
// need no common clock with this computer.
class Continuity {
 public:
  explicit Continuity(const RobotModel& robot) : max_v_mps_(robot.max_v_mps) {}

  // arrived_s: by a clock of this computer that never steps.
  [[nodiscard]] Observation continued(Observation observation, double arrived_s);
  // The next observation may be of a base that has started again: it is taken to stand where it was last seen, unless
  // its clock and odometry go on.
  void interrupt() { is_interrupted_ = true; }
  // How often the base's clock has been set.
  [[nodiscard]] int clock_steps() const { return clock_steps_; }

 private:
  struct Last {
    double arrived_s = 0.0;
    double stamp_s = 0.0;  // the base's
    Pose2 T_base_robot;    // the base's
    Observation given;
  };
  void restart_clock(double stamp_s, double arrived_s);

  double max_v_mps_;
  std::optional<Last> last_;
  double offset_s_ = 0.0;  // from the base's stamps to those given
  Pose2 T_odom_base_;      // from the base's odometry to that given
  double behind_s_ = 0.0;  // so old was the last one when it came, at least
  bool is_interrupted_ = false;
  int clock_steps_ = 0;
};

}  // namespace cairn::live
