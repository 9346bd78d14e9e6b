#include "framework/landmarks/marker_config.hpp"

namespace cairn {

PluginChoice default_marker_detector() {
  PluginChoice choice;
  choice.name = "april_tags";
  choice.config.kind = ConfigValue::Kind::map;
  return choice;
}

void MarkersConfig::describe(Fields<MarkersConfig>& fields) {
  fields.plugin("detector", &MarkersConfig::detector, "marker_detector", "finds markers in the robot's pictures");
  fields.raw("categories", &MarkersConfig::categories, "map",
             "categories of the landmarks that markers are, by their numbers: `{door: [3, 4], dock: [7]}`");
  fields.integer("confirm_sightings", &MarkersConfig::confirm_sightings, {1.0, 50.0},
                 "sightings from places some way apart until a marker counts as a landmark");
}

std::map<int, std::string> marker_categories_of(const MarkersConfig& config) {
  std::map<int, std::string> categories;
  if (config.categories.kind == ConfigValue::Kind::null) return categories;
  if (config.categories.kind != ConfigValue::Kind::map)
    throw ConfigError(config.categories.place, "categories must be a map of lists of ids, such as {door: [3, 4]}");
  for (const ConfigValue::Entry& entry : config.categories.entries) {
    const std::string what = "categories." + entry.key;
    for (const ConfigValue& item : config_detail::to_list(entry.value, what)) {
      const auto number = static_cast<int>(config_detail::to_integer(item, what, {0.0, 1e6}));
      if (!categories.emplace(number, entry.key).second)
        throw ConfigError(item.place, what + ": the id " + std::to_string(number) + " is of category " +
                                          categories.at(number) + " already");
    }
  }
  return categories;
}

}  // namespace cairn
