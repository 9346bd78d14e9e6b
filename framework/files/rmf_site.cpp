#include "framework/files/rmf_site.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "framework/config/fields.hpp"
#include "maps/base/printable.hpp"
#include "maps/base/text.hpp"
#include "maps/base/yaml_text.hpp"

namespace cairn::rmf {
namespace {

std::string json_text(std::string_view text) {
  std::string json = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20U) {
      char escape[8];
      std::snprintf(escape, sizeof(escape), "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      json += escape;
      continue;
    }
    if (c == '"' || c == '\\') json += '\\';
    json += c;
  }
  return json + '"';
}

// A plain scalar as YAML means it: true, 5, 0.5, else text.
std::string json_of_scalar(const ConfigValue& value) {
  const std::string& text = value.scalar;
  if (value.quoted) return json_text(text);
  if (text == "true" || text == "false") return text;
  const std::string_view number = exchange::without_plus_sign(text);
  if (const auto whole = number_from<std::int64_t>(number)) return std::to_string(*whole);
  if (const auto real = number_from<double>(number); real && std::isfinite(*real)) return exchange::yaml_number(*real);
  return json_text(text);
}

}  // namespace

std::string name_in(const ConfigValue& value, const std::string& what) {
  std::string name = config_detail::to_text(value, what);
  if (const std::size_t found = first_unprintable(name); found != std::string::npos)
    throw ConfigError(value.place, what + " " + in_quotes(name) + " holds " + name_of_unprintable(name, found));
  return name;
}

const ConfigValue* Properties::find(const std::string& key) const {
  const auto found = std::ranges::find(entries, key, &std::pair<std::string, ConfigValue>::first);
  return found == entries.end() ? nullptr : &found->second;
}

void Properties::erase(const std::string& key) {
  std::erase_if(entries, [&](const auto& entry) { return entry.first == key; });
}

void check_keys(const ConfigValue& map, const std::vector<std::string>& known, const std::string& what,
                std::vector<std::string>& warnings) {
  if (map.kind != ConfigValue::Kind::map)
    throw ConfigError(map.place, what + " must be a map, found " + map.kind_name());
  for (const ConfigValue::Entry& entry : map.entries) {
    if (std::ranges::find(known, entry.key) != known.end()) continue;
    const std::string hint = did_you_mean(entry.key, known);
    const std::string sentence = fmt::format("unknown key {}{} in {}", in_quotes(entry.key), hint, what);
    if (!hint.empty()) throw ConfigError(entry.key_place, sentence);
    warnings.push_back(fmt::format("{}: {}, not read", entry.key_place.text(), sentence));
  }
}

const std::vector<ConfigValue>& list_in(const ConfigValue& map, const std::string& key) {
  static const std::vector<ConfigValue> kNothing;
  const ConfigValue* value = map.find(key);
  const bool is_nothing = value == nullptr || value->kind == ConfigValue::Kind::null ||
                          (value->kind == ConfigValue::Kind::map && value->entries.empty());
  return is_nothing ? kNothing : config_detail::to_list(*value, key);
}

double number(const ConfigValue& value, const std::string& what) {
  return config_detail::to_number(value, what, {-kMaxCoordinate, kMaxCoordinate}, "");
}

std::size_t vertex_index(const ConfigValue& edge, std::size_t position, std::size_t vertices) {
  if (edge.kind != ConfigValue::Kind::list || edge.items.size() < 2)
    throw ConfigError(edge.place, "a lane must be [from, to, {...}], found " + edge.kind_name());
  const ConfigValue& value = edge.items[position];
  const auto index = config_detail::to_integer(value, "the number of a vertex", {0.0, 1e9});
  if (static_cast<std::size_t>(index) >= vertices)
    throw ConfigError(value.place, "there is no vertex " + std::to_string(index) + ": the level has " +
                                       std::to_string(vertices) + ", the first is 0");
  return static_cast<std::size_t>(index);
}

void check_orientation(const Properties& properties, const std::string& key) {
  const ConfigValue* value = properties.find(key);
  if (value != nullptr && !(value->kind == ConfigValue::Kind::scalar && value->scalar.empty()))
    static_cast<void>(config_detail::to_choice(*value, key, {"forward", "backward"}));
}

bool is_true(const ConfigValue* value) {
  return value != nullptr && value->kind == ConfigValue::Kind::scalar && !value->quoted && value->scalar == "true";
}

std::string json_of(const ConfigValue& value) {
  if (value.kind == ConfigValue::Kind::null) return "null";
  if (value.kind == ConfigValue::Kind::scalar) return json_of_scalar(value);
  std::string text;
  for (const ConfigValue& item : value.items) text += (text.empty() ? "" : ",") + json_of(item);
  if (value.kind == ConfigValue::Kind::list) return "[" + text + "]";
  for (const ConfigValue::Entry& entry : value.entries)
    text += (text.empty() ? "" : ",") + json_text(entry.key) + ":" + json_of(entry.value);
  return "{" + text + "}";
}

std::string json_of(const Properties& properties) {
  std::string text;
  for (const auto& [key, value] : properties.entries)
    text += (text.empty() ? "" : ",") + json_text(key) + ":" + json_of(value);
  return "{" + text + "}";
}

}  // namespace cairn::rmf
