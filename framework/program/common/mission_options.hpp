// The options of the commands below `cairn mission`, of `cairn experiment`, and of the pace of `cairn run`.
#pragma once

#include "framework/program/common/command_line.hpp"

namespace cairn {

// --pace and --realtime; 0: as fast as the machine. The number must outlive the parsing.
void add_pace(CLI::App* run, double& pace);
// The line must outlive the parsing.
void add_mission(CLI::App& app, CommandLine& line);
void add_experiment(CLI::App& app, CommandLine& line);

}  // namespace cairn
