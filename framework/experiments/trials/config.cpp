#include "framework/experiments/trials/config.hpp"

namespace cairn {

void TrialsConfig::describe(Fields<TrialsConfig>& fields) {
  using C = TrialsConfig;
  fields.files("robots", &C::robots, "robot files; each mission takes one of them").required = true;
  fields.file("templates", &C::templates, "folder of the templates that landmarks are drawn from and recognised by")
      .required = true;
  fields.number("max_specular_ratio", &C::max_specular_ratio, {0.0, 1.0}, "",
                "each world's share of smooth surfaces is drawn from 0 to this");
  fields.number("explore_at_most_s", &C::explore_at_most_s, {0.0, 1e6}, "s", "exploring, which comes first");
  fields.integer("min_goals", &C::min_goals, {1.0, 100.0}, "at least so many goals before the path home");
  fields.integer("max_goals", &C::max_goals, {1.0, 100.0}, "at most so many");
  fields.number("goal_at_most_s", &C::goal_at_most_s, {10.0, 1e6}, "s",
                "for each goal, and as much to look for its landmark before");
  fields.number("anywhere_ratio", &C::anywhere_ratio, {0.0, 1.0}, "",
                "share of the places that are drawn anywhere, also where nothing can stand; the others have room");
  fields.group("faults_per_hour", &C::faults_per_hour, "how often each fault of the simulated robot strikes");
  fields.number("fault_for_s", &C::fault_for_s, {0.0, 1e6}, "s", "how long each lasts");
  fields.number("battery_ratio", &C::battery_ratio, {0.0, 1.0}, "",
                "share of the missions whose battery lasts 5 to 20 minutes; the others have none that empties");
  fields.number(
      "clearance_m", &C::clearance_m, {0.0, 1.0}, "m",
      "beside the footprint's disc, at the place and all along the path to it, for a goal to count as reachable");
  fields.number("off_m", &C::off_m, {0.01, 10.0}, "m",
                "beyond the goal's tolerance_m, from the goal in truth: reached; from its own estimate: displaced");
  fields.number("fast_mps", &C::fast_mps, {0.0, 10.0}, "m/s", "a contact faster than this is a fast one");
  fields.number("longest_stand_s", &C::longest_stand_s, {1.0, 1e6}, "s",
                "neither moving nor turning nor waiting on purpose for longer is a hang");
  fields.integer("max_fast_contacts", &C::max_fast_contacts, {0.0, 1e6},
                 "limit: fast contacts with what could be seen, over all missions");
  fields.integer("max_stop_ticks", &C::max_stop_ticks, {1.0, 1000.0},
                 "limit: the tick without readings, from 1, in which the robot is ordered to stand at the latest");
  fields.number("max_wall_s", &C::max_wall_s, {0.1, 1e6}, "s",
                "limit: wall clock of a mission; reported as a hang, decides nothing in the mission");
}

}  // namespace cairn
