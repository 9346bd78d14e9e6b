// A second participant, in a process of its own, that orders the wheels to stand when this one cannot.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <span>

#include "framework/live/guard_process.hpp"
#include "plugins/ros2_robot/config.hpp"
#include "plugins/ros2_robot/dds/endpoints.hpp"

namespace cairn::ros2_robot {

struct GuardOrder {
  NetworkChoice network;
  CommandTopic velocity;
  std::chrono::milliseconds silence{300};  // without a sign of life
};

// Starts that program, which is to call run_guard(). Throws std::runtime_error.
[[nodiscard]] std::unique_ptr<live::GuardProcess> guard_of(const GuardOrder& order,
                                                           const std::filesystem::path& program);

// main() of that program; beats come on its standard input. Returns its exit status.
[[nodiscard]] int run_guard(std::span<const char* const> arguments);

}  // namespace cairn::ros2_robot
