// The charts of an experiment, where its kind has any, and the maps of one of places.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/experiments/experiment.hpp"

namespace cairn {

// PNG files in the folder. Returns why charts are missing, a sentence each.
std::vector<std::string> write_charts(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows,
                                      const std::filesystem::path& out);

}  // namespace cairn
