#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iostream>

#include "framework/host/experiment_report.hpp"
#include "framework/program/commands.hpp"
#include "framework/program/experiment_charts.hpp"
#include "framework/program/interrupt.hpp"

namespace cairn {
namespace {

// Wall clock: differs from run to run, so it is in no file.
std::string times_text(const std::vector<ExperimentRow>& rows) {
  double speed = 0.0;
  double detector_s = 0.0;
  std::int64_t matchings = 0;
  for (const ExperimentRow& row : rows) {
    speed += row.result.time_s / std::max(row.wall_s, 1e-9) / static_cast<double>(rows.size());
    detector_s += row.detector_wall_s;
    matchings += row.result.matchings;
  }
  std::string text = fmt::format("Mean speed {:.0f} times real time.", speed);
  if (matchings > 0)
    text += fmt::format(" The detector took {:.0f} us a matching, all its work included.",
                        1e6 * detector_s / static_cast<double>(matchings));
  return text + "\n";
}

}  // namespace

int experiment(const ExperimentCommand& command, const CommonOptions& common) {
  const ExperimentConfig config = load_experiment(command.file);
  const ModuleLibrary library(plugin_folders(common.plugin_folders));
  std::filesystem::create_directories(command.out);
  const std::vector<ExperimentRow> rows = run_experiment(config, library, command.out, cancel_on_interrupt());
  const std::string table = table_of(config, rows);
  const std::string json = json_of(config, rows);
  std::ofstream(command.out / "table.md") << table;
  std::ofstream(command.out / "table.json") << json << "\n";
  for (const std::string& missing : write_charts(config, rows, command.out)) std::cerr << "cairn: " << missing << "\n";
  if (common.json) std::cout << json << "\n";
  std::ostream& people = common.json ? std::cerr : std::cout;
  people << table << times_text(rows) << "Table: " << (command.out / "table.md").string() << "\n";
  const auto share = [&](auto is_well) {
    return static_cast<double>(std::count_if(rows.begin(), rows.end(), is_well)) / static_cast<double>(rows.size());
  };
  if (config.experiment != ExperimentKind::missions)
    return share([](const ExperimentRow& row) { return row.result.outcome == MissionOutcome::done; }) == 1.0
               ? kExitDone
               : kExitNotSolved;
  return share([](const ExperimentRow& row) { return row.is_good(); }) >= config.at_least_ratio ? kExitDone
                                                                                                : kExitNotSolved;
}

}  // namespace cairn
