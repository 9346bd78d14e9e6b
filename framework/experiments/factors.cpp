#include "framework/experiments/factors.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace cairn {
namespace {

constexpr std::string_view kPlace = "{}";

std::string with_value(const std::string& assignment, const std::string& value) {
  std::string text;
  for (std::size_t from = 0;;) {
    const std::size_t at = assignment.find(kPlace, from);
    text += assignment.substr(from, at - from);
    if (at == std::string::npos) return text;
    text += value;
    from = at + kPlace.size();
  }
}

// value: the factor as it stands in the file.
void check_factor(const FactorConfig& factor, const ConfigValue& value) {
  if (factor.values.empty()) throw ConfigError(value.place, "a factor must list its values");
  if (std::ranges::none_of(factor.set, [](const std::string& text) { return text.find(kPlace) != std::string::npos; }))
    throw ConfigError(value.place, "a factor must say under set which setting takes its value, as KEY={}");
  for (const std::string& text : factor.values)
    if (text.find('/') != std::string::npos)
      throw ConfigError(value.find("values")->place,
                        "a factor's value names a folder too, and \"" + text + "\" cannot be one");
}

// Others could be taken for the punctuation of a list or a map.
bool is_plain(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-' || c == '+';
  });
}

std::string quoted_yaml(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

bool takes_prefix(std::string& assignment, std::string_view prefix) {
  if (!assignment.starts_with(prefix)) return false;
  assignment.erase(0, prefix.size());
  return true;
}

}  // namespace

void add_factor_variants(ExperimentConfig& config, const ConfigValue& root) {
  for (std::size_t i = 0; i < config.vary.size(); ++i) {
    FactorConfig& factor = config.vary[i];
    check_factor(factor, root.find("vary")->items[i]);
    if (factor.label.empty()) factor.label = factor.name;
    for (const std::string& value : factor.values) {
      ExperimentVariant& variant = config.variants.emplace_back();
      variant.name = factor.name + " " + value;
      variant.factor = factor.name;
      variant.value = value;
      for (const std::string& assignment : factor.set) variant.overrides.push_back(with_value(assignment, value));
    }
  }
}

void sort_overrides(ExperimentVariant& variant, const ConfigValue& root) {
  ConfigValue settings;
  settings.kind = ConfigValue::Kind::map;
  settings.place = root.place;
  if (const ConfigValue* worlds = root.find("worlds")) settings = *worlds;
  bool has_worlds = false;
  std::vector<std::string> of_the_mission;
  for (std::string& assignment : variant.overrides) {
    if (takes_prefix(assignment, "robot.")) {
      variant.robot_overrides.push_back(std::move(assignment));
    } else if (takes_prefix(assignment, "worlds.")) {
      apply_override(settings, assignment);
      has_worlds = true;
    } else if (assignment.starts_with("specular_ratio=")) {
      ConfigValue own;
      own.kind = ConfigValue::Kind::map;
      own.place = root.place;
      apply_override(own, assignment);
      variant.specular_ratio = config_detail::to_number(*own.find("specular_ratio"), "specular_ratio", {0.0, 1.0}, "");
    } else {
      of_the_mission.push_back(std::move(assignment));
    }
  }
  variant.overrides = std::move(of_the_mission);
  if (has_worlds) variant.worlds = load_config<RandomWorldConfig>(settings, "worlds");
}

std::string yaml_of(const ConfigValue& value) {
  std::string text;
  switch (value.kind) {
    case ConfigValue::Kind::null:
      return "null";
    case ConfigValue::Kind::scalar:
      return value.quoted || !is_plain(value.scalar) ? quoted_yaml(value.scalar) : value.scalar;
    case ConfigValue::Kind::list:
      for (const ConfigValue& item : value.items) text += (text.empty() ? "" : ", ") + yaml_of(item);
      return "[" + text + "]";
    case ConfigValue::Kind::map:
      for (const ConfigValue::Entry& entry : value.entries)
        text += (text.empty() ? "" : ", ") + quoted_yaml(entry.key) + ": " + yaml_of(entry.value);
      return "{" + text + "}";
  }
  return text;
}

}  // namespace cairn
