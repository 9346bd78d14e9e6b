// `cairn run --localize-in`, `--pose`: which map, where in it, and what the mission does first.
#pragma once

#include <optional>
#include <string>

#include "framework/mission/runner.hpp"
#include "framework/program/common/commands.hpp"

namespace cairn {

struct MapToLocaliseIn {
  SavedMap map;
  std::optional<Pose2> T_map_start;  // as the command line gives it
};

// --pose, if there is one. Throws std::runtime_error when it is none, or there is no map for it.
[[nodiscard]] std::optional<Pose2> pose_given(const RunCommand& command);

// A saved map to work with. Where nothing but its submaps is damaged it comes without them, and standard error says so.
// Throws StoreError.
[[nodiscard]] SavedMap load_map_to_work_with(const std::filesystem::path& file);

// None unless the command line names one. Throws StoreError, and as pose_given().
[[nodiscard]] std::optional<MapToLocaliseIn> map_to_localise_in(const RunCommand& command);

// A robot that drives and does not know where it is finds itself first, unless the mission says when.
void begin_with_finding_itself(Mission& mission);

// For people: what the robot knows of its place at the end.
[[nodiscard]] std::string trust_text(const LocalisationFigures& figures);

}  // namespace cairn
