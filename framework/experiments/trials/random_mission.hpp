// Random missions for experiments: a robot somewhere in a world, what goes wrong with it, and a behaviour tree.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/world.hpp"
#include "framework/experiments/trials/config.hpp"

namespace cairn {

struct MissionFiles {  // as the mission names them
  std::filesystem::path robot;
  std::filesystem::path world;
  std::filesystem::path templates;
};

// The text of a mission file. Drawn are
// - the start: where the robot has room, not in a door and not near where somebody begins to walk; turned anyhow;
// - the faults of its first hour, a stream a kind, so that another rate of one leaves the others where they were; and
//   whether its battery will be empty some time;
// - the steps: exploring for a bounded time; then goals: going to a place, to a landmark of a category that the world
//   has, touring two or three places, patrolling them twice; each under one of: nothing (a failure ends the mission),
//   force_success, retry, timeout, retry of timeout, a fallback to another place, a reactive sequence, two rounds;
//   waits in between; at last the path back to the start, under `force_success`.
// The map frame is the world's. The robot and the world are those that the files name. Throws ConfigError when the
// robot has room nowhere in the world.
[[nodiscard]] std::string random_mission_yaml(const TrialsConfig& config, const MissionFiles& files,
                                              const RobotModel& robot, const World& world, std::uint64_t seed);

}  // namespace cairn
