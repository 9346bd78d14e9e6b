// The doors and movers of a world file. Throws ConfigError.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/world.hpp"

namespace cairn::world_config {

struct ClosesConfig {
  double every_s = 60.0;
  double for_s = 20.0;
  double first_s = 0.0;
  static void describe(Fields<ClosesConfig>& fields);
};

struct DoorConfig {
  std::string name;
  Point from_m{0.0, 0.0};
  Point to_m{0.0, 0.0};
  Surface surface = Surface::smooth;
  ConfigValue closed_s;
  std::optional<ClosesConfig> closes;
  static void describe(Fields<DoorConfig>& fields);
};

struct MoverConfig {
  std::string name;
  double circle_diameter_m = 0.0;
  std::vector<Point> polygon_m;
  std::vector<Point> path_m;
  double speed_mps = 0.5;
  double pause_s = 0.0;
  Course course = Course::there_and_back;
  double start_s = 0.0;
  Surface surface = Surface::rough;
  bool waits = true;
  double keeps_m = 0.3;
  static void describe(Fields<MoverConfig>& fields);
};

// value: the map that the config was loaded from. The world's bounds are set.
[[nodiscard]] WorldDoor door_of(const World& world, const DoorConfig& config, const ConfigValue& value);
[[nodiscard]] WorldMover mover_of(const World& world, const MoverConfig& config, const ConfigValue& value);
// Doors and movers are distinguished by their names, where they have any. root: the world file.
void check_names(const ConfigValue& root);

[[nodiscard]] std::vector<std::pair<std::string, Surface>> surfaces();
[[nodiscard]] std::string point_text(const Point& p);
// Throws when the point lies outside the world's bounds; what: as the sentence calls it.
void check_inside(const World& world, const Point& p, const SourcePlace& place, const std::string& what);

}  // namespace cairn::world_config
