// What has come of exploring random homes, in words and figures.
#pragma once

#include <string>
#include <vector>

#include "framework/experiments/experiment.hpp"

namespace cairn {

// Markdown: a row a variant, then a row a run; where tags hang in the homes, a second table of these.
[[nodiscard]] std::string homes_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

// Whether each variant that need not be the baseline has entered at_least_ratio of the rooms, knows as much of the area
// and had no fast contact that could be seen; and, where tags hang, has found as large a share of those within sight
// and none that is not there.
[[nodiscard]] bool keeps_homes_limits(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

}  // namespace cairn
