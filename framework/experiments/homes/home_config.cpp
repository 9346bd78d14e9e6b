#include "framework/experiments/homes/home.hpp"

namespace cairn {

void HomesConfig::describe(Fields<HomesConfig>& fields) {
  using C = HomesConfig;
  fields.integer("min_rooms", &C::min_rooms, {1.0, 100.0}, "at least so many rooms, a corridor among them");
  fields.integer("max_rooms", &C::max_rooms, {1.0, 100.0}, "at most so many");
  fields.number("min_area_m2", &C::min_area_m2, {10.0, 1e4}, "m2", "smallest area of all rooms with their walls");
  fields.number("max_area_m2", &C::max_area_m2, {10.0, 1e4}, "m2", "largest area");
  fields.number("min_door_m", &C::min_door_m, {0.3, 3.0}, "m", "narrowest door");
  fields.number("max_door_m", &C::max_door_m, {0.3, 3.0}, "m", "widest door");
  fields.number("corridor_ratio", &C::corridor_ratio, {0.0, 1.0}, "",
                "share of the homes with at least four rooms that have them along a corridor");
  fields.number("corner_ratio", &C::corner_ratio, {0.0, 1.0}, "", "share of the others that may lack a corner");
  fields.number("wall_m", &C::wall_m, {0.0, 0.5}, "m", "thickness of the walls");
  fields.integer("max_furniture", &C::max_furniture, {0.0, 20.0}, "at most so many pieces of furniture in a room");
  fields.number("gap_m", &C::gap_m, {0.1, 5.0}, "m", "free space between furniture, and before walls");
  fields.integer("tags", &C::tags, {0.0, 100.0}, "so many printed tags (AprilTags 36h11) hang on walls and furniture");
  fields.number("tag_size_m", &C::tag_size_m, {0.02, 1.0}, "m", "side of their black squares");
  fields.number("tag_tolerance_m", &C::tag_tolerance_m, {0.0, 10.0}, "m",
                "a tag of the map that is further from the truth is a false one");
  fields.number("fast_mps", &C::fast_mps, {0.0, 10.0}, "m/s", "a contact faster than this is a fast one");
  fields.number("beyond_door_m", &C::beyond_door_m, {0.0, 2.0}, "m",
                "a room is entered when the robot's centre is this far inside its walls");
}

}  // namespace cairn
