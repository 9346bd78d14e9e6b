// What a description of settings (fields.hpp) comes to: its fields with name, unit, range and meaning.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "framework/config/config_value.hpp"

namespace cairn {

struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

// A module named in a file: `{plugin: NAME, ...its own fields}`.
struct PluginChoice {
  std::string name;
  ConfigValue config;  // the map without `plugin`; keeps the places
};

struct FieldSpec {
  std::string key;
  std::string type;  // "number", "integer", "flag", "text", "choice", "file", "point", "list of ...", "map"
  std::string unit;  // "m", "deg", ... or empty
  Range range;
  std::vector<std::string> choices;
  std::string meaning;
  std::string default_text;
  bool required = false;
  std::string plugin_kind;        // of a plugin: "planner", ...
  std::vector<FieldSpec> fields;  // of a nested struct, with its shorthand and its one_of
  std::string shared;             // of a nested struct that several modules have: what the reference calls it
  std::string shorthand;
  std::vector<std::string> one_of;
  std::function<void(void* config, const ConfigValue& value)> load;
};

// A key that is no field any more, and what stands in its place.
struct MovedKey {
  std::string key;
  std::string now;
};

struct Schema {
  std::vector<FieldSpec> fields;
  std::string shorthand;  // the field that a scalar or list in place of the map stands for
  // Exactly one of these must be given. Shown to readers of the reference and the schema; whoever loads
  // the struct asks config_detail::exactly_one_of which one it is.
  std::vector<std::string> one_of;
  std::vector<MovedKey> moved;

  // Loads a map (or the shorthand) into a config object. what: "robot", "plugin explore", ... Throws ConfigError: the
  // first mistake, with all others that do not depend on it; what is right is loaded then too.
  void load_into(void* config, const ConfigValue& value, const std::string& what) const;
};

}  // namespace cairn
