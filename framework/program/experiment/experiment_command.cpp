#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "framework/experiments/contacts.hpp"
#include "framework/experiments/homes/table.hpp"
#include "framework/experiments/recognition/curves_table.hpp"
#include "framework/experiments/report.hpp"
#include "framework/experiments/trials/table.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/interrupt.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/common/output_files.hpp"
#include "framework/program/experiment/buildings_experiment.hpp"
#include "framework/program/experiment/experiment_charts.hpp"

namespace cairn {
namespace {

// Wall clock: differs from run to run, so it is in no file.
std::string times_text(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text =
      "| variant | times real time | detector s a run | detector us a matching, all its work included |\n"
      "|---|---:|---:|---:|\n";
  for (const ExperimentVariant& variant : config.variants) {
    double runs = 0.0;
    double speed = 0.0;
    double detector_s = 0.0;
    double matchings = 0.0;
    for (const ExperimentRow& row : rows) {
      if (row.variant != variant.name) continue;
      runs += 1.0;
      speed += row.result.time_s / std::max(row.wall_s, 1e-9);
      detector_s += row.detector_wall_s;
      matchings += static_cast<double>(row.result.matchings);
    }
    text += fmt::format("| {} | {:.0f} | {:.3f} | {} |\n", variant.name, speed / std::max(runs, 1.0),
                        detector_s / std::max(runs, 1.0),
                        matchings > 0.0 ? fmt::format("{:.0f}", 1e6 * detector_s / matchings) : "");
  }
  if (config.experiment == ExperimentKind::trials) text += "\n" + trial_times_table(config, rows);
  return text + "\n" + sweep_times_table(config, rows);
}

// Done when every run was, of missions when enough of them were good, of trials when all limits were kept.
int exit_status_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  const auto count = [&](auto is_so) { return std::count_if(rows.begin(), rows.end(), is_so); };
  const auto runs = static_cast<double>(rows.size());
  const bool cancelled =
      count([](const ExperimentRow& row) { return row.result.outcome == MissionOutcome::cancelled; }) > 0;
  const auto done = count([](const ExperimentRow& row) { return row.result.outcome == MissionOutcome::done; });
  const auto good = count([](const ExperimentRow& row) { return row.is_good(); });
  if (!keeps_contact_limit(config, rows)) return kExitNotSolved;
  if (config.experiment == ExperimentKind::trials)
    return !cancelled && broken_limits(config, rows).empty() && too_long(config, rows).empty() ? kExitDone
                                                                                               : kExitNotSolved;
  if (config.experiment == ExperimentKind::homes)
    return !cancelled && keeps_homes_limits(config, rows) ? kExitDone : kExitNotSolved;
  const bool enough = config.experiment != ExperimentKind::missions
                          ? static_cast<double>(done) == runs
                          : static_cast<double>(good) >= config.at_least_ratio * runs;
  return enough && !cancelled ? kExitDone : kExitNotSolved;
}

}  // namespace

int experiment(const ExperimentCommand& command, const CommonOptions& common) {
  const ExperimentConfig config = load_experiment(command.file, command.overrides);
  make_folder(command.out);
  if (config.experiment == ExperimentKind::buildings) return buildings_experiment(config, command.out);
  const ModuleLibrary library = module_library(common);
  const bool live = ::isatty(STDERR_FILENO) != 0;
  const auto tell = [live](std::size_t ended, std::size_t runs) {
    if (live) std::cerr << fmt::format("\r{} of {} runs{}", ended, runs, ended == runs ? "\n" : "") << std::flush;
  };
  const std::vector<ExperimentRow> rows = run_experiment(config, library, command.out, cancel_on_interrupt(), tell);
  const std::string table = table_of(config, rows);
  const std::string json = json_of(config, rows);
  write_file(command.out / "table.md", table);
  write_file(command.out / "table.json", json + "\n");
  for (const std::string& missing : write_charts(config, rows, command.out)) std::cerr << "cairn: " << missing << "\n";
  if (common.json) std::cout << json << "\n";
  std::ostream& people = common.json ? std::cerr : std::cout;
  people << table << times_text(config, rows) << "Table: " << (command.out / "table.md").string()
         << ", pictures beside it\n";
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
