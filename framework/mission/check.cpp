#include "framework/mission/check.hpp"

#include "framework/mission/modules.hpp"

namespace cairn {
namespace {

void look_at(const std::filesystem::path& file, const std::vector<std::string>& overrides, const ModuleLibrary& library,
             MissionCheck& check) {
  const ReadMission read = read_mission(file, overrides);
  check.mission = read.mission.config.mission;
  check.steps = read.mission.steps.size();
  check.nodes = count_nodes(read.mission.steps);
  for (const ConfigError& error : read.errors) check.errors.emplace_back(error.what());
  for (const ConfigError& error : read.step_errors) check.errors.emplace_back(error.what());
  // Modules are made of the robot and the world.
  if (!read.has_files) return;
  for (std::string& error : check_modules(read.mission, library)) check.errors.push_back(std::move(error));
}

}  // namespace

MissionCheck check_mission(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                           const ModuleLibrary& library) {
  MissionCheck check;
  try {
    look_at(file, overrides, library, check);
  } catch (const std::runtime_error& error) {
    check.errors.emplace_back(error.what());
  }
  return check;
}

}  // namespace cairn
