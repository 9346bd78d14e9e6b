// The options of the commands that judge and solve pose graphs.
#pragma once

#include "framework/program/common/command_line.hpp"

namespace cairn {

// `cairn slam-eval`, `cairn slam-solve`. The line must outlive the parsing.
void add_slam(CLI::App& app, CommandLine& line);

}  // namespace cairn
