#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <limits>

#include "framework/host/experiment_report.hpp"
#include "framework/program/commands.hpp"
#include "framework/program/interrupt.hpp"
#include "framework/program/output_files.hpp"
#include "maps/pictures/chart.hpp"

namespace cairn {
namespace {

// A chart a measure: a place a mission, a series a variant, bars for the 95 % intervals.
Chart chart_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows, const RunMeasure& measure) {
  Chart chart;
  chart.title = measure.name + ", mean and 95 % interval";
  chart.y_label = measure.name;
  chart.x_names = missions_of(rows);
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  const auto variants = static_cast<double>(config.variants.size());
  for (std::size_t v = 0; v < config.variants.size(); ++v) {
    Series series{config.variants[v].name, {}, SeriesStyle::points, {}};
    const double beside = 0.7 * ((static_cast<double>(v) + 0.5) / variants - 0.5);
    for (std::size_t m = 0; m < chart.x_names.size(); ++m) {
      const std::vector<double> values = known_values(rows_of(rows, chart.x_names[m], series.name), measure);
      if (values.empty()) continue;
      const Estimate estimate = estimate_of(values);
      series.points.emplace_back(static_cast<double>(m) + beside, estimate.mean);
      series.half_widths.push_back(estimate.half_width);
      least = std::min(least, estimate.mean);
      most = std::max(most, estimate.mean);
    }
    chart.series.push_back(std::move(series));
  }
  chart.log_y = least > 0.0 && most > 10.0 * least;
  return chart;
}

std::string file_name_of(const std::string& measure) {
  std::string name = measure + ".png";
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

void write_charts(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows,
                  const std::filesystem::path& out) {
  for (const RunMeasure& measure : map_measures()) {
    const Chart chart = chart_of(config, rows, measure);
    if (std::all_of(chart.series.begin(), chart.series.end(), [](const Series& s) { return s.points.empty(); }))
      continue;
    const ChartOutcome outcome = write_chart(out / file_name_of(measure.name), chart);
    if (!outcome.drawn) std::cerr << "cairn: " << outcome.reason << "\n";
  }
}

// Done when every run was, and of missions when enough of them were good.
int exit_status_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  const auto count = [&](auto is_so) { return std::count_if(rows.begin(), rows.end(), is_so); };
  const auto runs = static_cast<double>(rows.size());
  const bool cancelled =
      count([](const ExperimentRow& row) { return row.result.outcome == MissionOutcome::cancelled; }) > 0;
  const auto done = count([](const ExperimentRow& row) { return row.result.outcome == MissionOutcome::done; });
  const auto good = count([](const ExperimentRow& row) { return row.is_good(); });
  const bool enough = config.experiment == ExperimentKind::maps
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
  if (config.experiment == ExperimentKind::maps) write_charts(config, rows, command.out);
  if (common.json) std::cout << json << "\n";
  std::ostream& people = common.json ? std::cerr : std::cout;
  double speed = 0.0;
  for (const ExperimentRow& row : rows)
    speed += row.result.time_s / std::max(row.wall_s, 1e-9) / static_cast<double>(rows.size());
  people << table
         << fmt::format("Mean speed {:.0f} times real time. Table: {}\n", speed, (command.out / "table.md").string());
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
