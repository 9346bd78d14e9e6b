// Names of the files that steps write into the output folder.
#pragma once

#include <string>

#include "framework/config/config_value.hpp"

namespace cairn::behaviours {

// A plain name with this ending, the usual one where none is given. The ending keeps it apart from what the run itself
// writes (report.json, map.png). Throws ConfigError.
[[nodiscard]] std::string file_name_of(const ConfigValue& value, const std::string& usual, const std::string& ending);

}  // namespace cairn::behaviours
