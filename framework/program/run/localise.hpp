// `cairn run --localize-in`: which map, and what the mission does first.
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

// None unless the command line names one. Throws StoreError, and std::runtime_error for a pose that is none.
[[nodiscard]] std::optional<MapToLocaliseIn> map_to_localise_in(const RunCommand& command);

// A robot that drives and does not know where it is finds itself first, unless the mission says when.
void begin_with_finding_itself(Mission& mission);

// For people: what the robot knows of its place at the end.
[[nodiscard]] std::string trust_text(const LocalisationFigures& figures);

}  // namespace cairn
