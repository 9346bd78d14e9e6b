#include "framework/experiments/recognition/curves_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/experiments/recognition/recognition_table.hpp"
#include "framework/experiments/report.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

using Rows = std::vector<const ExperimentRow*>;

std::string table_of(const ExperimentConfig& config, const Rows& rows) {
  std::string text = "| detector | threshold | precision | recall | F1 |\n|---|---:|---:|---:|---:|\n";
  const RecognitionFigures own = recognition_figures(rows, rows.front()->step_rad);
  text += fmt::format("| the mission itself | | {} | {} | {} |\n", text_of(own.precision), text_of(own.recall),
                      text_of(own.f1));
  for (const ComparedDetector& detector : config.detectors) {
    const CurveFigures figures = best_figures(worlds_of(rows, detector.name));
    text += fmt::format("| {} | {:.3f} | {} | {} | {} |\n", detector.name, figures.threshold,
                        text_of(figures.precision), text_of(figures.recall), text_of(figures.f1));
  }
  return text;
}

}  // namespace

std::vector<WorldCounts> worlds_of(const Rows& rows, const std::string& detector) {
  std::vector<WorldCounts> worlds;
  for (const ExperimentRow* row : rows)
    for (const DetectorSweep& sweep : row->sweeps)
      if (sweep.detector == detector) worlds.push_back(sweep.counts);
  return worlds;
}

std::string curves_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text;
  for (const std::string& mission : missions_of(rows))
    for (const ExperimentVariant& variant : config.variants) {
      const Rows of_variant = rows_of(rows, mission, variant.name);
      if (of_variant.empty()) continue;
      text += fmt::format(
          "### {}, {}\n\n{}; 95 % intervals. A landmark further than {:.2f} m from everything is false. The "
          "mission itself: what it has recognised along its whole drive. The others: on its finished grid at once, "
          "each "
          "at the threshold where its F1 is highest on these grids.\n\n{}\n",
          mission, variant.name, counted(of_variant.size(), "world"), config.tolerance_m, table_of(config, of_variant));
    }
  return text;
}

std::string sweep_times_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text;
  for (const ComparedDetector& detector : config.detectors) {
    std::vector<double> times_ms;
    for (const ExperimentRow& row : rows)
      for (const DetectorSweep& sweep : row.sweeps)
        if (sweep.detector == detector.name) times_ms.push_back(1e3 * sweep.wall_s);
    text += fmt::format("| {} | {} |\n", detector.name, text_of(estimate_of(times_ms), 1));
  }
  return text.empty() ? text : "| detector | ms a grid |\n|---|---:|\n" + text;
}

}  // namespace cairn
