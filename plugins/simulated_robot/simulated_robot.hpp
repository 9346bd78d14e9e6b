// A robot in a simulated world: drives, bumps, measures. Plugin `simulated_robot`, kind sensor.
//
// Each next() advances the clock by one firing period, moves doors and movers, then the robot by what was commanded
// within its limits, and fires one transducer. The same robot, world, start, config, seed and commands give the
// same observations; odometry, compass, ranges and faults draw from streams of their own.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/ground_truth.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/sensor.hpp"
#include "framework/contracts/world.hpp"
#include "plugins/simulated_robot/body.hpp"
#include "plugins/simulated_robot/config.hpp"
#include "plugins/simulated_robot/faults.hpp"
#include "plugins/simulated_robot/instruments.hpp"
#include "plugins/simulated_robot/scene.hpp"
#include "plugins/simulated_robot/sonar_echo.hpp"
#include "plugins/simulated_robot/traffic.hpp"
#include "plugins/simulated_robot/witness.hpp"

namespace cairn {

class SimulatedRobot final : public Sensor, public Drive, public GroundTruthSource {
 public:
  // begin_s: the clock to begin with. Doors, movers and faults are then as if the robot had stood at its start so long;
  // the battery is full, and what put the robot elsewhere has done so.
  // Throws std::invalid_argument without a world, or when the firing order names no sonar of the robot; ConfigError
  // when a fault cannot be.
  SimulatedRobot(const SimulatedRobotConfig& config, const RobotModel& robot, const World* world,
                 const Pose2& T_map_start, std::uint64_t seed, double begin_s = 0.0);
  SimulatedRobot(const SimulatedRobot&) = delete;  // its parts refer to its scene
  SimulatedRobot& operator=(const SimulatedRobot&) = delete;

  // Never ends. A start inside a wall or an object is a fault, in every call.
  SensorStep next(const Budget& budget) override;
  Drive* drive() override { return this; }
  [[nodiscard]] const GroundTruthSource* truth() const override { return this; }
  [[nodiscard]] std::optional<GroundTruth> last_truth() const override;

  // Throws std::invalid_argument when not finite.
  void command(const Twist& twist) override;

  [[nodiscard]] int collisions() const { return collisions_; }  // touches, each counted once
  [[nodiscard]] const Twist& twist() const { return twist_; }

 private:
  void catch_up(double begin_s);
  [[nodiscard]] Twist towards_wanted() const;
  void move();
  void carry_off();
  void note_touch(const Move& move, const Pose2& T_map_before, const Twist& going);
  void use_battery();
  void fire_into(std::vector<RangeReading>& ranges, int sonar);
  [[nodiscard]] RangeReading fire(int sonar);

  SimulatedRobotConfig config_;
  RobotModel robot_;
  Scene scene_;
  Traffic traffic_;
  Body body_;
  std::vector<SonarEcho> echoes_;  // one a transducer
  std::vector<int> firing_order_;
  double period_s_;
  bool fire_all_;
  std::string fault_;

  Pose2 T_map_robot_;
  bool has_observed_ = false;
  Twist wanted_;
  Twist twist_;
  bool bumped_ = false;
  std::optional<Contact> contact_;  // that this tick began
  int collisions_ = 0;
  std::int64_t ticks_ = 0;
  Odometer odometer_;
  Compass compass_;
  NoiseStream range_noise_;
  Faults faults_;
  Witness witness_;
  double battery_ratio_;
};

}  // namespace cairn
