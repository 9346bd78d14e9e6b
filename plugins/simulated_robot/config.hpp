// Settings of the simulated robot; what belongs to a robot (limits, sonars, errors) is in its own file.
#pragma once

#include <optional>
#include <vector>

#include "framework/config/fields.hpp"
#include "plugins/simulated_robot/fault_config.hpp"
#include "plugins/simulated_robot/truth_config.hpp"

namespace cairn {

// How an echo comes about. Levels are dB relative to a smooth wall, head on, on the axis, at 1 m.
// Lobe angles and the numbers below are those of a Polaroid transducer (nominal half-beam 15 deg);
// another half-beam scales all of its lobes.
struct EchoConfig {
  int rays = 31;
  double side_lobe_rad = radians(25.0);
  double far_side_lobe_rad = radians(42.0);
  double side_lobe_db = -16.0;
  double far_side_lobe_db = -22.0;
  double threshold_db = -40.0;
  double absorption_db_per_m = 3.0;
  double rough_db = -12.0;  // what a Lambert surface sends back of a 15 deg beam, against a mirror
  double edge_db = -20.0;
  double bounce_db = -2.0;
  int max_bounces = 4;

  static void describe(Fields<EchoConfig>& fields) {
    fields.integer("rays", &EchoConfig::rays, {3, 1001}, "rays a reading, spread evenly over all lobes");
    fields.angle("side_lobe_deg", &EchoConfig::side_lobe_rad, {0, 90}, "outer edge of the first side lobe");
    fields.angle("far_side_lobe_deg", &EchoConfig::far_side_lobe_rad, {0, 90}, "outer edge of the second side lobe");
    fields.number("side_lobe_db", &EchoConfig::side_lobe_db, {-100, 0}, "dB", "first side lobe, one way");
    fields.number("far_side_lobe_db", &EchoConfig::far_side_lobe_db, {-100, 0}, "dB", "second side lobe, one way");
    fields.number("threshold_db", &EchoConfig::threshold_db, {-200, 0}, "dB", "weakest echo that is received");
    fields.number("absorption_db_per_m", &EchoConfig::absorption_db_per_m, {0, 100}, "dB/m",
                  "loss in air per metre of range, both ways together");
    fields.number("rough_db", &EchoConfig::rough_db, {-100, 0}, "dB", "a rough surface, head on");
    fields.number("edge_db", &EchoConfig::edge_db, {-100, 0}, "dB", "a corner seen from outside, a wall's end");
    fields.number("bounce_db", &EchoConfig::bounce_db, {-100, 0}, "dB", "each mirror bounce, both ways together");
    fields.integer("max_bounces", &EchoConfig::max_bounces, {0, 10}, "mirror bounces that a ray is followed for");
  }
};

// What is left falls evenly: by standing, and by the more the faster it goes.
struct BatteryConfig {
  double standing_s = 7200.0;
  double driving_s = 3600.0;
  double start_ratio = 1.0;

  static void describe(Fields<BatteryConfig>& fields) {
    fields.number("standing_s", &BatteryConfig::standing_s, {1.0, 1e9}, "s", "a full one lasts so long standing");
    fields.number("driving_s", &BatteryConfig::driving_s, {1.0, 1e9}, "s",
                  "and so long at full speed; an empty one moves nothing");
    fields.number("start_ratio", &BatteryConfig::start_ratio, {0.0, 1.0}, "", "what is in it at the start");
  }
};

struct SimulatedRobotConfig {
  bool fire_all = false;
  double tick_s = 0.04;
  bool compass = true;
  double emergency_braking_ratio = 4.0;
  double turn_as_distance_m_per_rad = 0.1;
  EchoConfig echo;
  TruthConfig truth;
  std::vector<FaultConfig> faults;
  std::optional<RandomFaultsConfig> random_faults;
  std::optional<BatteryConfig> battery;

  static void describe(Fields<SimulatedRobotConfig>& fields) {
    fields.flag("fire_all", &SimulatedRobotConfig::fire_all, "every transducer each tick instead of one");
    fields.number("tick_s", &SimulatedRobotConfig::tick_s, {0.001, 10.0}, "s",
                  "time between observations of a robot whose firing period is 0 (all its transducers at once)");
    fields.flag("compass", &SimulatedRobotConfig::compass, "whether the robot has one");
    fields.number("emergency_braking_ratio", &SimulatedRobotConfig::emergency_braking_ratio, {1.0, 100.0}, "",
                  "so much harder than by command it brakes when it is stopped or a command's time has passed");
    fields.number("turn_as_distance_m_per_rad", &SimulatedRobotConfig::turn_as_distance_m_per_rad, {0, 10}, "m/rad",
                  "driven distance that a turn in place counts as for the heading error of the odometry");
    fields.group("echo", &SimulatedRobotConfig::echo, "the sonar model");
    fields.group("truth", &SimulatedRobotConfig::truth,
                 "in what the robot that drives differs from its file, which all other modules keep to");
    FieldSpec& faults = fields.list("faults", &SimulatedRobotConfig::faults, "what goes wrong, and when");
    faults.load = [load = faults.load](void* config, const ConfigValue& value) {
      load(config, value);
      check_faults(static_cast<SimulatedRobotConfig*>(config)->faults, value);
    };
    fields.group("random_faults", &SimulatedRobotConfig::random_faults,
                 "what goes wrong by chance; the mission's seed draws it");
    fields.group("battery", &SimulatedRobotConfig::battery, "the robot's battery; without it, none is reported");
  }
};

}  // namespace cairn
