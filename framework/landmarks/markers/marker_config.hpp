// The settings under `markers` of a mission.
#pragma once

#include <map>
#include <span>
#include <string>

#include "framework/config/fields.hpp"
#include "maps/landmarks/marker_id.hpp"

namespace cairn {

[[nodiscard]] PluginChoice default_marker_detector();

struct MarkersConfig {
  PluginChoice detector = default_marker_detector();
  ConfigValue categories;  // {door: [3, 4], dock: [7]}
  int confirm_sightings = 3;
  static void describe(Fields<MarkersConfig>& fields);
};

// Of the numbers of markers, whichever their family. categories: as the settings have them. Throws ConfigError.
[[nodiscard]] std::map<int, std::string> marker_categories_of(const ConfigValue& categories);
// Throws ConfigError when none of the families has a marker that the categories name.
void check_marker_numbers(const ConfigValue& categories, std::span<const MarkerFamily> families);

}  // namespace cairn
