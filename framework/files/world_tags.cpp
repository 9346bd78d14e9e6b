#include "framework/files/world_tags.hpp"

#include <string>

#include "framework/files/world_moving.hpp"

namespace cairn::world_config {
void TagConfig::describe(Fields<TagConfig>& fields) {
  fields.integer("id", &TagConfig::id, {0, 2114}, "its number in its family").required = true;
  fields.choice("family", &TagConfig::family,
                {{"36h11", MarkerFamily::tag36h11},
                 {"25h9", MarkerFamily::tag25h9},
                 {"standard41h12", MarkerFamily::tagStandard41h12}},
                "which AprilTags it is of");
  fields.point("at_m", &TagConfig::at_m, "m", "where its centre is on the floor plan: on the face of what it hangs on")
      .required = true;
  fields.angle("facing_deg", &TagConfig::facing_rad, {-360.0, 360.0}, "which way its printed side looks, in the map")
      .required = true;
  fields.number("height_m", &TagConfig::height_m, {0.0, 10.0}, "m", "of its centre above the floor");
  fields.number("size_m", &TagConfig::size_m, {0.005, 5.0}, "m",
                "side of the square whose corners are detected: of 36h11 and 25h9 the black border's outside, of "
                "standard41h12 the white border's outside");
}

WorldTag tag_of(const World& world, const TagConfig& config, const ConfigValue& value) {
  check_inside(world, config.at_m, value.find("at_m")->place, "at_m");
  if (const int markers = count_of(config.family); config.id >= markers)
    throw ConfigError(value.find("id")->place, "family " + std::string(name_of(config.family)) + " has the ids 0 to " +
                                                   std::to_string(markers - 1) + ", found " +
                                                   std::to_string(config.id));
  if (config.height_m < 0.5 * config.size_m)
    throw ConfigError(value.place, "the tag's lower edge is below the floor: height_m is of its centre");
  return {{config.family, config.id},
          {config.at_m.x(), config.at_m.y(), wrap_angle(config.facing_rad)},
          config.height_m,
          config.size_m};
}

}  // namespace cairn::world_config
