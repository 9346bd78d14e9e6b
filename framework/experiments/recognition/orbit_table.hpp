// The degrees along an orbit, in bins, over all seeds: as a table, and as what a chart draws.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/experiments/experiment.hpp"
#include "framework/experiments/statistics.hpp"

namespace cairn {

// One line of a chart: a value in the middle of each bin of the orbit, none where fewer than half of the
// runs had a matching.
struct OrbitSeries {
  std::string name;
  std::vector<std::optional<Estimate>> bins;
};
// In each run the last matching of a bin counts.
[[nodiscard]] std::vector<OrbitSeries> orbit_categories(const ExperimentConfig& config,
                                                        const std::vector<const ExperimentRow*>& rows);
[[nodiscard]] std::vector<OrbitSeries> orbit_templates(const ExperimentConfig& config,
                                                       const std::vector<const ExperimentRow*>& rows);

// Of the templates of the landmark's category, which one fits best in a run's last matching: orientation, in whole
// degrees, and number of runs.
[[nodiscard]] std::map<int, int> best_at_the_end(const std::vector<const ExperimentRow*>& rows);

// "square 15 deg"
[[nodiscard]] std::string template_name(const ExperimentConfig& config, int orientation_deg);

// Markdown; a table a mission and variant.
[[nodiscard]] std::string orbit_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

}  // namespace cairn
