// A parsed configuration file as a tree of values that know where they stand.
//
// Neutral between the YAML reader (config_file.cpp) and the field descriptions (fields.hpp).
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "maps/base/spelling.hpp"

namespace cairn {

struct SourcePlace {
  std::string file;  // as the user named it; "--set KEY" for an option of the command line
  int line = 0;      // from 1; 0: no line
  int column = 0;    // from 1

  [[nodiscard]] std::string text() const;  // "file:line:column"
  bool operator==(const SourcePlace&) const = default;
};

// Bad input from outside: what() is "file:line:column: sentence".
class ConfigError : public std::runtime_error {
 public:
  ConfigError(const SourcePlace& place, const std::string& sentence, std::vector<ConfigError> others = {})
      : std::runtime_error(place.text() + ": " + sentence),
        place_(place),
        sentence_(sentence),
        others_(std::move(others)) {}

  [[nodiscard]] const SourcePlace& place() const { return place_; }
  [[nodiscard]] const std::string& sentence() const { return sentence_; }
  // Further mistakes that were found together with this one (config_errors.hpp); none has others of its own.
  [[nodiscard]] const std::vector<ConfigError>& others() const { return others_; }

 private:
  SourcePlace place_;
  std::string sentence_;
  std::vector<ConfigError> others_;
};

class ConfigValue {
 public:
  enum class Kind { null, scalar, list, map };
  struct Entry;

  Kind kind = Kind::null;
  SourcePlace place;
  std::string scalar;
  bool quoted = false;             // a quoted scalar is text, never a number
  std::vector<ConfigValue> items;  // list
  std::vector<Entry> entries;      // map, in the order of the file; keys are unique

  [[nodiscard]] const ConfigValue* find(std::string_view key) const;
  [[nodiscard]] ConfigValue* find(std::string_view key);
  // "a number", "a list", ...: for error messages.
  [[nodiscard]] std::string kind_name() const;
};

struct ConfigValue::Entry {
  std::string key;
  SourcePlace key_place;
  ConfigValue value;
};

// Reads a YAML file. Throws ConfigError on a missing file, a syntax error, a duplicate key, an
// anchor cycle, or nesting deeper than 64. An empty file is an empty map.
[[nodiscard]] ConfigValue read_config_file(const std::filesystem::path& file);
// The same for text; file_name stands in the places.
[[nodiscard]] ConfigValue parse_config_text(const std::string& text, const std::string& file_name);

// Applies a command line override "a.b.c=value" (list items by number, "steps.0.explore.at_most_s"),
// creating maps on the path. Throws ConfigError when the text has no '=' or the path meets a scalar; its place names
// the option of the command line that the text was given to.
void apply_override(ConfigValue& root, const std::string& assignment, const std::string& option = "--set");

// A path in a file: ${NAME} and ${NAME:-default} are read from the environment, then relative
// paths are taken from the folder of the file that names them.
[[nodiscard]] std::filesystem::path resolve_path(const ConfigValue& value);

}  // namespace cairn
