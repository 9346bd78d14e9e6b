// How well several detectors do on the same grids, each at its best threshold, beside the mission itself.
#pragma once

#include <string>
#include <vector>

#include "framework/experiments/experiment.hpp"

namespace cairn {

// What one of the experiment's detectors found in the runs that came to the end.
[[nodiscard]] std::vector<WorldCounts> worlds_of(const std::vector<const ExperimentRow*>& rows,
                                                 const std::string& detector);

// Markdown.
[[nodiscard]] std::string curves_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

// Markdown: wall clock, so it belongs into no file that is to be the same again. Empty without any.
[[nodiscard]] std::string sweep_times_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

}  // namespace cairn
