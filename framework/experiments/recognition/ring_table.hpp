// The rings of all runs of a variant together: as a table, and as what a chart draws.
#pragma once

#include <string>
#include <vector>

#include "framework/experiments/experiment.hpp"

namespace cairn {

// Mean OL in each bin of ring_profile(), with the interval from resampling the worlds; of a bin without a cell nothing.
struct RingBin {
  double distance_m = 0.0;  // of the bin's middle from the outline
  Interval ol;
};
[[nodiscard]] std::vector<RingBin> ring_bins(const std::vector<const ExperimentRow*>& rows);

// Markdown: where the ring of each variant lies. Empty unless the experiment asks for it.
[[nodiscard]] std::string ring_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

}  // namespace cairn
