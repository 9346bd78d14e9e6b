// The robot's transducers: which one fires when, and what each reads with its errors.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"
#include "plugins/simulated_robot/config.hpp"
#include "plugins/simulated_robot/noise_stream.hpp"
#include "plugins/simulated_robot/sonar_echo.hpp"

namespace cairn {

class SonarRing {
 public:
  // The scene must outlive the object. Throws std::invalid_argument when the firing order names no sonar of the robot.
  SonarRing(const SimulatedRobotConfig& config, const RobotModel& robot, const Scene& scene, std::uint64_t seed);

  // The readings of a tick, counted from 1: of the transducer whose turn it is, or of all.
  [[nodiscard]] std::vector<RangeReading> fire(const Pose2& T_map_robot, std::int64_t tick);

 private:
  [[nodiscard]] RangeReading read(const Pose2& T_map_robot, int sonar);

  std::vector<SonarModel> sonars_;  // as the robot's file has them
  std::vector<SonarEcho> echoes_;   // one a transducer, as it is in truth
  std::vector<int> firing_order_;
  bool fires_all_;
  RangeError error_;
  NoiseStream noise_;
};

}  // namespace cairn
