#include "plugins/behaviours/driving/settings.hpp"

namespace cairn::behaviours {

void FaceSettings::describe(Fields<FaceSettings>& fields) {
  fields.angle("faced_deg", &FaceSettings::faced_rad, {0.1, 90.0}, "a heading error within this is faced");
  fields.number("at_most_s", &FaceSettings::at_most_s, {0.0, 600.0}, "s",
                "when it takes longer, the robot has arrived all the same");
}

void DrivingSettings::describe(Fields<DrivingSettings>& fields) {
  using C = DrivingSettings;
  fields.group("planning", &C::planning, "what the mission's planner is asked, and how often");
  fields.group("follow", &C::follow, "following the path by the mission's controller");
  fields.group("progress", &C::progress, "when the robot is blocked");
  fields.group("recovery", &C::recovery, "what it tries when it is blocked for its patience");
  fields.group("look", &C::look, "looking whether a blockage has gone");
  fields.group("optimism", &C::optimism, "paths where the planner finds none");
  fields.group("lookout_costs", &C::lookout_costs, "where it goes to look when there is no path");
  fields.group("local_map", &C::local_map, "the map about the robot, corrected by near echoes");
  fields.group("obstacles", &C::obstacles, "what is near the robot now");
  fields.group("turn", &C::turn, "turning in place");
  fields.group("face", &C::face, "turning to the goal's heading");
}

}  // namespace cairn::behaviours
