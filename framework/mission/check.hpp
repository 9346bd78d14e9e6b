// Everything that is wrong with a mission's files, found without running it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/mission/mission.hpp"
#include "framework/modules/module_library.hpp"

namespace cairn {

struct MissionCheck {
  std::string mission;              // its name; empty when its file could not be read
  std::vector<std::string> errors;  // sentences with their places; empty: the mission can be run
  std::size_t steps = 0;
  std::size_t nodes = 0;  // the steps among them
};

// Throws nothing that a file can cause.
[[nodiscard]] MissionCheck check_mission(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                                         const ModuleLibrary& library);

}  // namespace cairn
