// The options of the commands below `cairn mission`.
#pragma once

#include "framework/program/common/command_line.hpp"

namespace cairn {

// The line must outlive the parsing.
// --pace and --realtime of `cairn run`.
void add_pace(CLI::App* run, double& pace);
void add_mission(CLI::App& app, CommandLine& line);

}  // namespace cairn
