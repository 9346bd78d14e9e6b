#include "framework/landmarks/config.hpp"

namespace cairn {

void LandmarksConfig::describe(Fields<LandmarksConfig>& fields) {
  using C = LandmarksConfig;
  fields.choice("association", &C::association,
                {{"template_sets", AssociationRule::template_sets}, {"distance", AssociationRule::distance}},
                "which landmark a detection is of: by place, pose error and template sets, or by distance alone");
  fields.number("merge_m", &C::merge_m, {0.01, 10.0}, "m",
                "by distance alone: a detection this near to a landmark is that landmark");
  fields.number("place_m", &C::place_m, {0.01, 10.0}, "m",
                "standard deviation of where a matching places a landmark in its map");
  fields.angle("orientation_deg", &C::orientation_rad, {1.0, 90.0},
               "standard deviation of how a matching turns a landmark");
  fields.number("degree_scale", &C::degree_scale, {0.001, 1.0}, "", "a degree higher by this is e times as likely");
  fields.number("chance_ratio", &C::chance_ratio, {0.0001, 1.0}, "",
                "share of template sets that say nothing of the landmark");
  fields.number("unknown_per_m2", &C::unknown_per_m2, {1e-6, 100.0}, "1/m2",
                "landmarks that are not known yet on a square metre");
  fields.integer("confirm_sightings", &C::confirm_sightings, {1.0, 1000.0},
                 "matchings that must find it before it counts as a landmark");
  fields.number("freed_ratio", &C::freed_ratio, {0.5, 1.0}, "",
                "a landmark is retired once this share of the cells inside its outline is seen free");
  fields.integer("routes_per_landmark", &C::routes_per_landmark, {0.0, 100.0},
                 "joined to this many nearest others by travel; more routes join what these leave apart");
  fields.number("driven_detour_ratio", &C::driven_detour_ratio, {1.0, 100.0}, "",
                "a driven path is kept when it is at most this much longer than the planned one");
  fields.number(
      "access_margin_m", &C::access_margin_m, {0.0, 1.0}, "m",
      "free space kept round the robot at a landmark's approach pose and on driven routes, where there is room");
}

}  // namespace cairn
