// A robot in a simulated world: drives, bumps, measures. Plugin `simulated_robot`, kind sensor.
//
// Each next() advances the clock by one firing period, moves doors and movers, then the robot by what was commanded
// within its limits, and fires one transducer. The same robot, world, start, config, seed and commands give the
// same observations; odometry, compass, ranges and faults draw from streams of their own.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "framework/contracts/ground_truth.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/sensor.hpp"
#include "framework/contracts/world.hpp"
#include "plugins/simulated_robot/battery.hpp"
#include "plugins/simulated_robot/camera/cameras.hpp"
#include "plugins/simulated_robot/config.hpp"
#include "plugins/simulated_robot/faults.hpp"
#include "plugins/simulated_robot/instruments.hpp"
#include "plugins/simulated_robot/laser_scanner.hpp"
#include "plugins/simulated_robot/motors.hpp"
#include "plugins/simulated_robot/sonar_ring.hpp"
#include "plugins/simulated_robot/surroundings/body.hpp"
#include "plugins/simulated_robot/surroundings/scene.hpp"
#include "plugins/simulated_robot/surroundings/traffic.hpp"
#include "plugins/simulated_robot/surroundings/witness.hpp"

namespace cairn {

class SimulatedRobot final : public Sensor, public Drive, public GroundTruthSource {
 public:
  // begin_s: the clock to begin with. Doors, movers and faults are then as if the robot had stood at its start so long;
  // the battery is full, and what put the robot elsewhere has done so.
  // wants_images: its cameras take pictures; without it they cost nothing.
  // Throws std::invalid_argument without a world, or when the firing order names no sonar of the robot; ConfigError
  // when a fault cannot be.
  SimulatedRobot(const SimulatedRobotConfig& config, const RobotModel& robot, const World* world,
                 const Pose2& T_map_start, std::uint64_t seed, double begin_s = 0.0, bool wants_images = false);
  SimulatedRobot(const SimulatedRobot&) = delete;  // its parts refer to its scene
  SimulatedRobot& operator=(const SimulatedRobot&) = delete;

  // Never ends. A start inside a wall or an object is a fault, in every call.
  SensorStep next(const Budget& budget) override;
  Drive* drive() override { return this; }
  [[nodiscard]] const GroundTruthSource* truth() const override { return this; }
  [[nodiscard]] std::optional<GroundTruth> last_truth() const override { return truth_; }

  // Throws std::invalid_argument when not finite.
  void command(const Twist& twist, double valid_for_s) override { motors_.command(twist, valid_for_s); }
  void stop() noexcept override { motors_.stop(); }

  [[nodiscard]] int collisions() const { return collisions_; }  // touches, each counted once
  [[nodiscard]] const Twist& twist() const { return motors_.twist(); }

 private:
  void catch_up(double begin_s);
  std::optional<Contact> move();
  void carry_off();
  std::optional<Contact> touch(const Move& move, const Pose2& T_map_before, const Twist& going);
  [[nodiscard]] double time_s() const { return static_cast<double>(ticks_) * period_s_; }

  double period_s_;
  Scene scene_;
  Traffic traffic_;
  Body body_;
  Motors motors_;
  Battery battery_;
  Odometer odometer_;
  std::optional<Compass> compass_;
  SonarRing sonars_;
  LaserScanners lasers_;
  std::optional<Cameras> cameras_;
  Faults faults_;
  Witness witness_;
  std::string start_fault_;

  Pose2 T_map_robot_;
  std::optional<GroundTruth> truth_;  // of the last observation
  std::int64_t ticks_ = 0;
  bool bumped_ = false;
  int collisions_ = 0;
  std::vector<RangeReading> scanned_;  // of one tick; kept for its memory
};

}  // namespace cairn
