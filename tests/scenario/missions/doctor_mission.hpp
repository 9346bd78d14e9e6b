// A mission whose robot has one sonar, for `cairn doctor live`.
#pragma once

#include <filesystem>
#include <string>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {

inline const char* const kOneSonar = R"(name: one sonar
radius_m: 0.2
kinematics: differential
limits: {max_v_mps: 0.4, max_w_degps: 60, max_acceleration_mps2: 0.5, max_turn_acceleration_degps2: 100}
sonars:
  - {x_m: 0.1, y_m: 0, angle_deg: 0, half_beam_deg: 15, min_m: 0.1, max_m: 5}
firing: {order: [0], period_s: 0.04}
odometry: {distance_ratio: 0.01, distance_bias_ratio: 0, heading_deg_per_m: 0.5}
)";

// sensor: its settings as YAML, without the braces.
inline std::filesystem::path doctor_mission(const std::string& name, const std::string& sensor) {
  const std::filesystem::path folder = fresh_folder(name);
  write_text(folder / "robot.yaml", kOneSonar);
  write_text(folder / "mission.yaml", "mission: " + name + "\nrobot: robot.yaml\nsensor: {" + sensor +
                                          "}\nlocalizer: {plugin: odometry_compass}\nmap: {plugin: muriel}\n"
                                          "collision_monitor: {blind_s: 0.5}\nsteps:\n  - wait: 1\n");
  return folder / "mission.yaml";
}

}  // namespace cairn::testing_program
