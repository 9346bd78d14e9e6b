#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <limits>

#include "framework/host/experiment_report.hpp"
#include "framework/program/commands.hpp"
#include "framework/program/interrupt.hpp"
#include "maps/pictures/chart.hpp"

namespace cairn {
namespace {

// A chart a measure: a place a mission, a series a variant, bars for the 95 % intervals.
Chart chart_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows, const RunMeasure& measure) {
  Chart chart;
  chart.title = measure.name + ", mean and 95 % interval";
  chart.y_label = measure.name;
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  const auto variants = static_cast<double>(config.variants.size());
  for (std::size_t v = 0; v < config.variants.size(); ++v) {
    Series series{config.variants[v].name, {}, SeriesStyle::points, {}};
    const double beside = 0.7 * ((static_cast<double>(v) + 0.5) / variants - 0.5);
    chart.x_names.clear();
    for (const std::string& mission : missions_of(rows)) {
      std::vector<double> values;
      for (const ExperimentRow* row : rows_of(rows, mission, series.name))
        if (!measure.needs_truth || row->quality) values.push_back(measure.of(*row));
      if (values.empty()) continue;
      const Estimate estimate = estimate_of(values);
      series.points.emplace_back(static_cast<double>(chart.x_names.size()) + beside, estimate.mean);
      series.half_widths.push_back(estimate.half_width);
      chart.x_names.push_back(mission);
    }
    for (const Point& p : series.points) {
      least = std::min(least, p.y());
      most = std::max(most, p.y());
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
    if (chart.x_names.empty() || (!measure.needs_truth && config.withhold_every == 0)) continue;
    const ChartOutcome outcome = write_chart(out / file_name_of(measure.name), chart);
    if (!outcome.drawn) std::cerr << "cairn: " << outcome.reason << "\n";
  }
}

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
  if (config.experiment == ExperimentKind::maps) write_charts(config, rows, command.out);
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
