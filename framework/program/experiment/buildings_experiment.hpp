// The experiment `buildings`: what questions to the maps of small and large buildings cost.
#pragma once

#include <filesystem>

#include "framework/experiments/config.hpp"

namespace cairn {

// Makes the maps under `out`, asks this very program about them (`cairn plan`), each time in a process of its own, and
// writes the table to `out` and to standard output. An exit status: whether every answer is as it must be.
[[nodiscard]] int buildings_experiment(const ExperimentConfig& config, const std::filesystem::path& out);

}  // namespace cairn
