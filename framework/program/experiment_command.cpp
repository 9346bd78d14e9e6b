#include <fmt/format.h>

#include <fstream>
#include <iostream>

#include "framework/host/mission_experiment.hpp"
#include "framework/program/commands.hpp"
#include "framework/program/interrupt.hpp"

namespace cairn {

int experiment(const ExperimentCommand& command, const CommonOptions& common) {
  const ExperimentConfig config = load_experiment(command.file);
  const ModuleLibrary library(plugin_folders(common.plugin_folders));
  std::filesystem::create_directories(command.out);
  const std::vector<ExperimentRow> rows = run_experiment(config, library, command.out, cancel_on_interrupt());
  const std::string table = table_of(config, rows);
  const std::string json = json_of(config, rows);
  std::ofstream(command.out / "table.md") << table;
  std::ofstream(command.out / "table.json") << json << "\n";
  if (common.json) std::cout << json << "\n";
  std::ostream& people = common.json ? std::cerr : std::cout;
  double speed = 0.0;
  for (const ExperimentRow& row : rows)
    speed += row.result.time_s / std::max(row.wall_s, 1e-9) / static_cast<double>(rows.size());
  people << table
         << fmt::format("Mean speed {:.0f} times real time. Table: {}\n", speed, (command.out / "table.md").string());
  const auto good = std::count_if(rows.begin(), rows.end(), [](const ExperimentRow& row) { return row.is_good(); });
  return static_cast<double>(good) >= config.at_least_ratio * static_cast<double>(rows.size()) ? kExitDone
                                                                                               : kExitNotSolved;
}

}  // namespace cairn
