#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "framework/host/curves_table.hpp"
#include "framework/host/experiment_report.hpp"
#include "framework/program/commands.hpp"
#include "framework/program/experiment_charts.hpp"
#include "framework/program/interrupt.hpp"
#include "framework/program/output_files.hpp"

namespace cairn {
namespace {

// Wall clock: differs from run to run, so it is in no file.
std::string times_text(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
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
  return text + "\n" + sweep_times_table(config, rows);
}

// Done when every run was, and of missions when enough of them were good.
int exit_status_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  const auto count = [&](auto is_so) { return std::count_if(rows.begin(), rows.end(), is_so); };
  const auto runs = static_cast<double>(rows.size());
  const bool cancelled =
      count([](const ExperimentRow& row) { return row.result.outcome == MissionOutcome::cancelled; }) > 0;
  const auto done = count([](const ExperimentRow& row) { return row.result.outcome == MissionOutcome::done; });
  const auto good = count([](const ExperimentRow& row) { return row.is_good(); });
  const bool enough = config.experiment != ExperimentKind::missions
                          ? static_cast<double>(done) == runs
                          : static_cast<double>(good) >= config.at_least_ratio * runs;
  return enough && !cancelled ? kExitDone : kExitNotSolved;
}

}  // namespace

int experiment(const ExperimentCommand& command, const CommonOptions& common) {
  const ExperimentConfig config = load_experiment(command.file);
  const ModuleLibrary library(plugin_folders(common.plugin_folders));
  make_folder(command.out);
  const std::vector<ExperimentRow> rows = run_experiment(config, library, command.out, cancel_on_interrupt());
  const std::string table = table_of(config, rows);
  const std::string json = json_of(config, rows);
  write_file(command.out / "table.md", table);
  write_file(command.out / "table.json", json + "\n");
  for (const std::string& missing : write_charts(config, rows, command.out)) std::cerr << "cairn: " << missing << "\n";
  if (common.json) std::cout << json << "\n";
  std::ostream& people = common.json ? std::cerr : std::cout;
  people << table << times_text(config, rows) << "Table: " << (command.out / "table.md").string() << "\n";
  const int status = exit_status_of(config, rows);
  if (std::any_of(rows.begin(), rows.end(), [](const ExperimentRow& row) { return row.gave_up; })) {
    // A lost call still runs: nothing that it may use can be torn down.
    std::cout.flush();
    std::cerr.flush();
    std::_Exit(status);
  }
  return status;
}

}  // namespace cairn
