// OMPL's own parameters of a planner, as a file gives them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/config/config_value.hpp"
#include "planners/ompl/search/algorithms.hpp"

namespace cairn {

using AlgorithmParameters = std::vector<std::pair<std::string, std::string>>;

// Checks a map of OMPL's own parameters against those of the algorithm. Throws ConfigError with the
// place and the nearest name.
[[nodiscard]] AlgorithmParameters checked_parameters(Algorithm algorithm, const ConfigValue& parameters);

}  // namespace cairn
