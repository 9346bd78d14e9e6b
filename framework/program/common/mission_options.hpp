// The options of the commands below `cairn mission`.
#pragma once

#include "framework/program/common/commands.hpp"
#include "framework/program/common/option_checks.hpp"

namespace cairn {

struct MissionOptions {
  MissionCheckCommand check;
  MissionShowCommand show;
  MissionControlCommand control;
};

// The options and the action must outlive the parsing.
void add_mission(CLI::App& app, MissionOptions& options, const CommonOptions& common, Action& action);

}  // namespace cairn
