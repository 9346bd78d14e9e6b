// The options of the commands that make or change files of maps: import, export, merge, crop, diff, close, open.
#pragma once

#include "framework/program/common/commands.hpp"
#include "framework/program/common/option_checks.hpp"

namespace cairn {

struct MapFileOptions {
  ExchangeCommand exchange;
  MergeCommand merge;
  CropCommand crop;
  DiffCommand diff;
  CloseCommand close;
};

// Below `cairn map`. The options and the action must outlive the parsing.
void add_map_files(CLI::App& app, MapFileOptions& options, const CommonOptions& common, Action& action);

}  // namespace cairn
