#include "framework/mission/named_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "maps/base/text.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

constexpr const char* kProperty = "named_values";
constexpr const char* kInput = "input";
constexpr const char* kOutput = "output";

ordered_json json_of(const Place& place) {
  ordered_json json = ordered_json::object();
  if (place.pose) json["pose"] = {place.pose->x_m, place.pose->y_m, place.pose->theta_rad};
  if (place.heading_matters) json["heading_matters"] = true;
  if (!place.landmarks.empty()) json["landmarks"] = place.landmarks;
  return json;
}

Place place_of(const ordered_json& json) {
  Place place;
  if (const auto pose = json.find("pose"); pose != json.end()) {
    const auto numbers = pose->get<std::vector<double>>();
    if (numbers.size() != 3 || !std::ranges::all_of(numbers, [](double n) { return std::isfinite(n); }))
      throw std::invalid_argument("a pose is not three numbers");
    place.pose = Pose2{numbers[0], numbers[1], numbers[2]};
  }
  place.heading_matters = json.value("heading_matters", false);
  place.landmarks = json.value("landmarks", std::vector<LandmarkId>{});
  return place;
}

// What a node's settings give for a field: its text, and where it stands.
const ConfigValue* name_in(const TreeNode& node, const RegisteredModule& module, const char* type) {
  for (const FieldSpec& field : module.schema.fields)
    if (field.type == type) return node.choice.config.find(field.key);
  return nullptr;
}

}  // namespace

void add_named_values(SavedMap& map, const NamedValues& values) {
  if (values.empty()) return;
  ordered_json json = ordered_json::object();
  for (const auto& [name, place] : values) json[name] = json_of(place);
  map.properties[kProperty] = json.dump();
}

NamedValues saved_named_values(const SavedMap& map) {
  const auto found = map.properties.find(kProperty);
  if (found == map.properties.end()) return {};
  NamedValues values;
  try {
    const ordered_json json = ordered_json::parse(found->second);
    if (!json.is_object() || json.size() > kMaxNamedValues) throw std::invalid_argument("it is not a table of places");
    for (const auto& [name, place] : json.items()) values[name] = place_of(place);
  } catch (const std::exception& error) {
    throw StoreError(fmt::format("cannot be resumed: its property {}: {}", kProperty, error.what()));
  }
  return values;
}

std::vector<ConfigError> missing_inputs(const std::vector<TreeNode>& steps, const ModuleLibrary& library) {
  std::vector<ConfigError> errors;
  std::vector<std::string> given;
  for (const TreeNode* node : behaviours_of(steps)) {
    const ModuleEntry* entry = library.find_of(PluginKind::behaviour, node->choice.name);
    if (entry == nullptr) continue;
    const ConfigValue* input = name_in(*node, *entry->module, kInput);
    if (input != nullptr && std::ranges::find(given, input->scalar) == given.end()) {
      const std::string known = joined(given);
      errors.emplace_back(input->place,
                          fmt::format("input: no step before gives {}{}; {}", in_quotes(input->scalar),
                                      did_you_mean(input->scalar, given),
                                      known.empty() ? "a step gives one by `output: NAME`" : "given are: " + known));
    }
    if (const ConfigValue* output = name_in(*node, *entry->module, kOutput)) given.push_back(output->scalar);
  }
  return errors;
}

}  // namespace cairn
