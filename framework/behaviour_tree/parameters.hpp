// Parameters of sub-missions: `$name` in place of a whole value.
//
// Only plain scalars are references: "$name" in quotes is text, and `${NAME}` in a path reads the environment.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/behaviour_tree/nodes.hpp"
#include "framework/config/config_value.hpp"

namespace cairn {

struct Parameters {
  std::string of;                             // the file, for messages
  std::map<std::string, ConfigValue> values;  // with the places where they were written
};

// What `with` gives, and defaults for the rest. place: of the node that runs the file. Throws ConfigError at the
// place of the first one that is unknown, missing or no name.
[[nodiscard]] Parameters bind_parameters(const SubMissionFile& sub, const std::string& file, const ConfigValue& with,
                                         const SourcePlace& place);

// Puts the values in. Parameters that are not known, and those that are never used, become errors; the first stay as
// they stand. values_left: what the result may hold at most, made less by what it holds; beyond it throws ConfigError.
[[nodiscard]] ConfigValue with_parameters(const ConfigValue& steps, const Parameters& parameters,
                                          std::size_t& values_left, std::vector<ConfigError>& errors);

// The error with the place of the node that uses the value, when it stands in another file than the node: a parameter
// that was given there. value: what the error is about holds it; place: of the node.
[[nodiscard]] ConfigError with_place_of_use(const ConfigError& error, const ConfigValue& value,
                                            const SourcePlace& place);

}  // namespace cairn
