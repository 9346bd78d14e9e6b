// The settings under `markers` of a mission.
#pragma once

#include <map>
#include <string>

#include "framework/config/fields.hpp"

namespace cairn {

[[nodiscard]] PluginChoice default_marker_detector();

struct MarkersConfig {
  PluginChoice detector = default_marker_detector();
  ConfigValue categories;  // {door: [3, 4], dock: [7]}
  int confirm_sightings = 3;
  static void describe(Fields<MarkersConfig>& fields);
};

// Of the numbers of markers, whichever their family. Throws ConfigError.
[[nodiscard]] std::map<int, std::string> marker_categories_of(const MarkersConfig& config);

}  // namespace cairn
