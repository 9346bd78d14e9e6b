// The settings under `landmarks` of a mission.
#pragma once

#include "framework/config/fields.hpp"

namespace cairn {

// How a detection is known to be of a landmark.
enum class AssociationRule { template_sets, distance };

struct LandmarksConfig {
  AssociationRule association = AssociationRule::template_sets;
  double merge_m = 0.4;                   // by distance alone: a detection this near to a landmark is that landmark
  double place_m = 0.05;                  // standard deviation of where a matching places a landmark, in its map
  double orientation_rad = radians(8.0);  // and of how it is turned
  double degree_scale = 0.02;             // a degree higher by this is e times as likely
  double chance_ratio = 0.02;             // of template sets that say nothing of the landmark
  double unknown_per_m2 = 0.1;            // landmarks not known yet
  int confirm_sightings = 3;              // matchings that must find it before it counts as a landmark
  double freed_ratio = 0.8;               // of the cells inside its outline: seen free, a landmark is retired
  int routes_per_landmark = 3;            // joined to this many nearest others by travel; more routes join what is left
  double driven_detour_ratio = 1.3;  // a driven path is kept when it is at most this much longer than the planned one
  double access_margin_m =
      0.12;  // free space kept round the robot at approach poses and on routes, where there is room
  static void describe(Fields<LandmarksConfig>& fields);
};

}  // namespace cairn
