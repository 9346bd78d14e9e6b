// The printed markers of a world file. Throws ConfigError.
#pragma once

#include "framework/config/fields.hpp"
#include "framework/contracts/world.hpp"

namespace cairn::world_config {

struct TagConfig {
  int id = 0;
  MarkerFamily family = MarkerFamily::tag36h11;
  Point at_m{0.0, 0.0};
  double facing_rad = 0.0;
  double height_m = 0.3;
  double size_m = 0.16;
  static void describe(Fields<TagConfig>& fields);
};

// value: the map that the config was loaded from. The world's bounds are set.
[[nodiscard]] WorldTag tag_of(const World& world, const TagConfig& config, const ConfigValue& value);

}  // namespace cairn::world_config
