#include "framework/config/config_value.hpp"

#include <algorithm>
#include <cstdlib>

#include "maps/base/printable.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

void set_places(ConfigValue& value, const SourcePlace& place) {
  value.place = place;
  for (ConfigValue& item : value.items) set_places(item, place);
  for (ConfigValue::Entry& entry : value.entries) {
    entry.key_place = place;
    set_places(entry.value, place);
  }
}

// The text behind '=' read as YAML, so that lists and quotes work as in a file.
ConfigValue override_value(const std::string& text, const SourcePlace& place) {
  if (text.find_first_not_of(" \t") == std::string::npos) {
    ConfigValue nothing;
    nothing.place = place;
    return nothing;
  }
  // A map or list on its own needs its place; errors inside keep theirs within the text.
  ConfigValue value = parse_config_text(text, place.file);
  set_places(value, place);
  return value;
}

ConfigValue& list_item(ConfigValue& list, const std::string& part, const SourcePlace& place) {
  const auto index = number_from<std::size_t>(part);
  if (index && *index < list.items.size()) return list.items[*index];
  const std::string allowed =
      list.items.empty() ? "the list there is empty" : "allowed: 0 to " + std::to_string(list.items.size() - 1);
  throw ConfigError(place, in_quotes(part) + " is not an item of the list at " + list.place.text() + "; " + allowed);
}

// The value below one part of the path; made when it is missing.
ConfigValue& child_of(ConfigValue& parent, const std::string& part, const SourcePlace& place) {
  if (parent.kind == ConfigValue::Kind::list) return list_item(parent, part, place);
  if (parent.kind == ConfigValue::Kind::scalar) {
    throw ConfigError(place, "no key " + in_quotes(part) + " below the value " + in_quotes(parent.scalar) + " at " +
                                 parent.place.text() + ", which is not a map");
  }
  if (parent.kind == ConfigValue::Kind::null) {
    parent.kind = ConfigValue::Kind::map;
    parent.place = place;
  }
  if (ConfigValue* child = parent.find(part)) return *child;
  ConfigValue::Entry entry{part, place, {}};
  entry.value.place = place;
  parent.entries.push_back(std::move(entry));
  return parent.entries.back().value;
}

std::vector<std::string> split_at_dots(const std::string& key) {
  std::vector<std::string> parts{""};
  for (const char c : key) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

bool is_variable_name(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return !name.empty() && is_letter(name.front()) &&
         std::ranges::all_of(name, [&](char c) { return is_letter(c) || is_digit(c); });
}

// The value of `NAME` or `NAME:-default`, the text between the braces.
std::string variable_value(std::string_view inside, const SourcePlace& place) {
  const std::size_t split = inside.find(":-");
  const std::string name(inside.substr(0, split));
  const bool has_default = split != std::string_view::npos;
  if (!is_variable_name(name)) {
    throw ConfigError(place, in_quotes("${" + std::string(inside) + "}") +
                                 " is not a variable; allowed: ${NAME} or ${NAME:-default}");
  }
  const char* value = std::getenv(name.c_str());
  if (value != nullptr && (*value != '\0' || !has_default)) return value;
  if (has_default) return std::string(inside.substr(split + 2));
  throw ConfigError(place, "the environment variable " + name + " is not set and ${" + name +
                               "} has no default; set it or write ${" + name + ":-default}");
}

std::string with_variables(const std::string& text, const SourcePlace& place) {
  std::string out;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t open = text.find("${", at);
    out += text.substr(at, open - at);
    if (open == std::string::npos) break;
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) throw ConfigError(place, "\"${\" without \"}\" in " + in_quotes(text));
    const std::string inside = text.substr(open + 2, close - open - 2);
    if (inside.find("${") != std::string::npos) {
      throw ConfigError(place, "a variable within a variable in " + in_quotes(text) + " is not supported");
    }
    out += variable_value(inside, place);
    at = close + 1;
  }
  return out;
}

// "a/../b" is "b" only where a is not a symbolic link.
std::filesystem::path simplified(const std::filesystem::path& path) {
  const std::filesystem::path simple = path.lexically_normal();
  std::error_code error;
  const bool differs = std::filesystem::exists(path, error) && !std::filesystem::equivalent(path, simple, error);
  return differs ? path : simple;
}

}  // namespace

std::string SourcePlace::text() const {
  if (line <= 0) return file;
  return file + ":" + std::to_string(line) + ":" + std::to_string(column);
}

const ConfigValue* ConfigValue::find(std::string_view key) const {
  const auto at = std::ranges::find(entries, key, &Entry::key);
  return at == entries.end() ? nullptr : &at->value;
}

ConfigValue* ConfigValue::find(std::string_view key) {
  const auto at = std::ranges::find(entries, key, &Entry::key);
  return at == entries.end() ? nullptr : &at->value;
}

std::string ConfigValue::kind_name() const {
  switch (kind) {
    case Kind::null:
      return "nothing";
    case Kind::list:
      return "a list";
    case Kind::map:
      return "a map";
    case Kind::scalar:
      break;
  }
  if (quoted) return "text";
  if (scalar == "true" || scalar == "false") return "a flag";
  return number_from<double>(scalar) ? "a number" : "text";
}

void apply_override(ConfigValue& root, const std::string& assignment, const std::string& option) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigError({option, 0, 0}, "expected KEY=VALUE, found " + in_quotes(assignment));
  }
  const std::string key = assignment.substr(0, equals);
  const SourcePlace place{option + " " + key, 0, 0};
  const std::vector<std::string> parts = split_at_dots(key);
  if (std::ranges::find(parts, "") != parts.end()) throw ConfigError(place, "a part of the key is empty");
  ConfigValue value = override_value(assignment.substr(equals + 1), place);
  ConfigValue* target = &root;
  for (const std::string& part : parts) target = &child_of(*target, part, place);
  *target = std::move(value);
}

std::filesystem::path resolve_path(const ConfigValue& value) {
  if (value.kind != ConfigValue::Kind::scalar) {
    throw ConfigError(value.place, "expected a path, found " + value.kind_name());
  }
  const std::filesystem::path path = with_variables(value.scalar, value.place);
  if (path.empty()) throw ConfigError(value.place, "expected a path, found an empty text");
  if (const std::size_t found = first_unprintable(path.native()); found != std::string::npos)
    throw ConfigError(value.place,
                      "the path " + in_quotes(path.native()) + " holds " + name_of_unprintable(path.native(), found));
  const bool from_a_file = value.place.line > 0;
  if (path.is_absolute() || !from_a_file) return simplified(path);
  return simplified(std::filesystem::path(value.place.file).parent_path() / path);
}

}  // namespace cairn
