// The options of `cairn view`.
#pragma once

#include "framework/program/common/command_line.hpp"

namespace cairn {

// The line must outlive the parsing.
void add_view(CLI::App& app, CommandLine& line);

}  // namespace cairn
