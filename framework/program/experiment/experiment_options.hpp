// The options of the commands that run experiments and draw their charts.
#pragma once

#include "framework/program/common/command_line.hpp"

namespace cairn {

// `cairn experiment`, `cairn chart`. The line must outlive the parsing.
void add_experiment(CLI::App& app, CommandLine& line);
void add_chart(CLI::App& app, CommandLine& line);

}  // namespace cairn
