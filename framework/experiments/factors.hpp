// One factor of a study at a time: its values become variants of the experiment.
#pragma once

#include <string>

#include "framework/experiments/config.hpp"

namespace cairn {

// Appends a variant for each value of each factor. Throws ConfigError.
void add_factor_variants(ExperimentConfig& config, const ConfigValue& root);

// Sorts a variant's overrides by what they are settings of: `robot.KEY=VALUE` the robot file, `worlds.KEY=VALUE` the
// random worlds, `specular_ratio=VALUE` the variant itself, all others the mission. Throws ConfigError.
void sort_overrides(ExperimentVariant& variant, const ConfigValue& root);

// The text of a YAML file that reads as this value. The places and comments of the file that it came from are lost.
[[nodiscard]] std::string yaml_of(const ConfigValue& value);

}  // namespace cairn
