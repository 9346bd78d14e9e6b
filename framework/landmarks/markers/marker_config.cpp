#include "framework/landmarks/markers/marker_config.hpp"

namespace cairn {
namespace {

int number_in(const ConfigValue& item, const std::string& what) {
  return static_cast<int>(config_detail::to_integer(item, what, {0.0, 1e6}));
}

}  // namespace

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

std::map<int, std::string> marker_categories_of(const ConfigValue& categories) {
  std::map<int, std::string> names;
  if (categories.kind == ConfigValue::Kind::null) return names;
  if (categories.kind != ConfigValue::Kind::map)
    throw ConfigError(categories.place, "categories must be a map of lists of ids, such as {door: [3, 4]}");
  for (const ConfigValue::Entry& entry : categories.entries) {
    if (entry.key.find_first_not_of(' ') == std::string::npos)
      throw ConfigError(entry.key_place, "categories: a category needs a name, such as {door: [3, 4]}");
    const std::string what = "categories." + entry.key;
    for (const ConfigValue& item : config_detail::to_list(entry.value, what)) {
      const int number = number_in(item, what);
      if (!names.emplace(number, entry.key).second)
        throw ConfigError(item.place, what + ": the id " + std::to_string(number) + " is of category " +
                                          names.at(number) + " already");
    }
  }
  check_marker_numbers(categories, kMarkerFamilies);
  return names;
}

void check_marker_numbers(const ConfigValue& categories, std::span<const MarkerFamily> families) {
  for (const ConfigValue::Entry& entry : categories.entries)
    for (const ConfigValue& item : entry.value.items) {
      const std::string what = "categories." + entry.key;
      const int number = number_in(item, what);
      if (const std::string fault = number_fault(number, families); !fault.empty())
        throw ConfigError(item.place, what + ": there is no tag with the id " + std::to_string(number) + ": " + fault);
    }
}

}  // namespace cairn
