// The options of the commands that make or change files of maps: import, export, merge, crop, diff, close, open.
#pragma once

#include "framework/program/common/command_line.hpp"

namespace cairn {

// Below `cairn map`. The line must outlive the parsing.
void add_map_files(CLI::App& app, CommandLine& line);

}  // namespace cairn
