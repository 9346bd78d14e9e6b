// What an Open-RMF file says, before it is a landmark graph: the same for navigation graphs and buildings.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/config/config_value.hpp"
#include "maps/geometry/pose.hpp"

namespace cairn::rmf {

inline constexpr double kMaxCoordinate = 1e6;  // pixels in the file, metres in the map

// The name that a value is; without control characters. what: it is for people. Throws ConfigError.
[[nodiscard]] std::string name_in(const ConfigValue& value, const std::string& what);

struct Properties {
  std::vector<std::pair<std::string, ConfigValue>> entries;

  [[nodiscard]] const ConfigValue* find(const std::string& key) const;
  void erase(const std::string& key);
};

struct Vertex {
  Point at_m{0.0, 0.0};
  std::string name;
  Properties properties;
};

struct Lane {
  std::size_t from = 0;
  std::size_t to = 0;
  Properties properties;
};

struct Level {
  std::string name;
  std::vector<Vertex> vertices;
  std::vector<Lane> lanes;
};

struct Site {
  std::vector<Level> levels;
  Properties others;  // what stands beside the levels
  std::vector<std::string> warnings;
};

[[nodiscard]] Site site_of_building(const ConfigValue& root);

// An unknown key is refused when it is spelt nearly like a known one, else a warning says that it is not read.
void check_keys(const ConfigValue& map, const std::vector<std::string>& known, const std::string& what,
                std::vector<std::string>& warnings);
// The value of the key, a list; an empty one when the key is missing or empty.
[[nodiscard]] const std::vector<ConfigValue>& list_in(const ConfigValue& map, const std::string& key);
[[nodiscard]] double number(const ConfigValue& value, const std::string& what);
// The index at that position of [from, to, ...].
[[nodiscard]] std::size_t vertex_index(const ConfigValue& edge, std::size_t position, std::size_t vertices);
// Text, as "forward": checks what it may be.
void check_orientation(const Properties& properties, const std::string& key);
[[nodiscard]] bool is_true(const ConfigValue* value);
[[nodiscard]] std::string json_of(const ConfigValue& value);
[[nodiscard]] std::string json_of(const Properties& properties);

}  // namespace cairn::rmf
