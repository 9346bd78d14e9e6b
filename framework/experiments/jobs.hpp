// The runs that an experiment consists of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/experiments/config.hpp"

namespace cairn {

struct ExperimentJob {
  std::filesystem::path mission;
  ExperimentVariant variant;
  std::int64_t seed = 0;
  std::filesystem::path out;  // folder of the run
};

// By mission, variant and seed. Throws ConfigError.
[[nodiscard]] std::vector<ExperimentJob> jobs_of(const ExperimentConfig& config, const std::filesystem::path& out);

}  // namespace cairn
