#include "plugins/behaviours/exploring/settings.hpp"

namespace cairn::behaviours {

void ChoiceSettings::describe(Fields<ChoiceSettings>& fields) {
  using C = ChoiceSettings;
  fields.number("every_s", &C::every_s, {0.1, 600.0}, "s", "the next task is chosen anew this often");
  fields.number("apart_s", &C::apart_s, {0.0, 600.0}, "s", "but no sooner than this after the last choice");
  fields.number("around_m", &C::around_m, {0.5, 1000.0}, "m",
                "tasks within this part of the map come first; the whole map is searched when there is none");
  fields.number("shut_in_ratio", &C::shut_in_ratio, {0.0, 1.0}, "",
                "the robot is shut in when it can go back to less than this share of the places where it was");
  fields.integer("near_trace_cells", &C::near_trace_cells, {0.0, 1000.0}, "this near to such a place counts");
  fields.number("narrow_radius_m", &C::narrow_radius_m, {0.01, 5.0}, "m",
                "an opening twice this wide is looked into, though it is too narrow on the map");
  fields.integer("far_edge_cells", &C::far_edge_cells, {0.0, 100.0},
                 "when nothing else is left, edges are looked at, too, that have free cells only within this; 0: none");
  fields.number("tight_clearance_m", &C::tight_clearance_m, {0.0, 5.0}, "m",
                "room kept beside the robot when it is shut in");
  fields.number("there_m", &C::there_m, {0.0, 5.0}, "m", "a place this near needs no drive");
  fields.number("trusted_range_m", &C::trusted_range_m, {0.1, 100.0}, "m",
                "new ground counts within this range: beyond it a sonar's beam is wider than a door");
}

void TaskWeights::describe(Fields<TaskWeights>& fields) {
  using C = TaskWeights;
  fields.number("orbit_bonus_m", &C::orbit_bonus_m, {0.0, 1000.0}, "m",
                "an orbit round an object may cost this much more path than another task and still come first");
  fields.number("frontier_bonus_m_per_m", &C::frontier_bonus_m_per_m, {0.0, 1000.0}, "m/m",
                "the same for each metre of a frontier");
  fields.number("max_frontier_bonus_m", &C::max_frontier_bonus_m, {0.0, 1000.0}, "m", "and at most this");
  fields.number("stay_bonus_m", &C::stay_bonus_m, {0.0, 1000.0}, "m", "the same for the task under way");
  fields.number("same_m", &C::same_m, {0.0, 100.0}, "m", "tasks of one kind this near to each other are the same");
  fields.integer("min_orbit_sectors", &C::min_orbit_sectors, {1.0, 24.0},
                 "an orbit begins only when so many of its 24 sectors are still to be seen");
  fields.number("orbit_from_m", &C::orbit_from_m, {0.0, 1000.0}, "m",
                "and from within this: from afar a piece of wall looks like an object");
  fields.number("max_detour_for_sector_m", &C::max_detour_for_sector_m, {0.0, 1000.0}, "m",
                "longest path to an orbit for each sector that is still to be seen");
  fields.number("is_landmark_m", &C::is_landmark_m, {0.0, 10.0}, "m",
                "an object this near to a known landmark is that landmark");
  fields.number("max_path_for_edges_m_per_m", &C::max_path_for_edges_m_per_m, {0.0, 1e4}, "m/m",
                "longest path to a small edge for each of its metres: far away they are mostly noise");
  fields.number("small_edge_m", &C::small_edge_m, {0.0, 100.0}, "m", "a shorter edge is small");
  fields.number("min_edge_m", &C::min_edge_m, {0.0, 100.0}, "m", "a shorter edge is left alone");
  fields.number("view_ratio", &C::view_ratio, {0.1, 1.0}, "",
                "share of the viewing distance from which things are looked at, so that arriving is seeing");
  fields.number("give_up_ratio", &C::give_up_ratio, {1.0, 100.0}, "",
                "of a task that showed nothing, all within this share of the viewing distance is given up");
  fields.number("frontier_view_m", &C::frontier_view_m, {0.1, 50.0}, "m", "viewing distance of frontiers");
  fields.angle("frontier_view_deg", &C::frontier_view_rad, {1.0, 180.0},
               "a frontier is seen within this of the robot's heading, to either side");
  fields.number("worthwhile_ratio", &C::worthwhile_ratio, {0.0, 1.0}, "",
                "a frontier is left when no more than this share of it is still unknown");
}

void ExploreMotionSettings::describe(Fields<ExploreMotionSettings>& fields) {
  using C = ExploreMotionSettings;
  fields.angle("look_around_degps", &C::look_around_radps, {1.0, 360.0}, "how fast it turns to look around", "deg/s");
  fields.number(
      "look_around_max_turns", &C::look_around_max_turns, {1.0, 100.0}, "turns",
      "looking around ends after the time that so many turns would take, when the robot is kept from turning");
  fields.number("blocked_ahead_m", &C::blocked_ahead_m, {0.0, 50.0}, "m",
                "something that turns up on the path within this makes it choose again");
  fields.number("blocked_clearance_ratio", &C::blocked_clearance_ratio, {0.0, 1.0}, "",
                "and is nearer to the path than the robot's radius and this share of the clearance");
  fields.number("arrived_m", &C::arrived_m, {0.001, 1.0}, "m", "this near to the end of a path is there");
  fields.number("on_orbit_m", &C::on_orbit_m, {0.0, 10.0}, "m", "this near to its first place it is on an orbit");
  fields.number("away_s", &C::away_s, {0.01, 600.0}, "s",
                "when it was not ticked for longer, something else has driven the robot: it begins with a look round");
  fields.number("trace_apart_m", &C::trace_apart_m, {0.01, 5.0}, "m",
                "where the robot was is remembered at this "
                "spacing");
  fields.angle("trace_turn_deg", &C::trace_turn_rad, {1.0, 180.0}, "and after a turn by this");
  fields.number("moved_m", &C::moved_m, {0.0, 10.0}, "m", "less is not a move");
}

void ExploreFaceSettings::describe(Fields<ExploreFaceSettings>& fields) {
  using C = ExploreFaceSettings;
  fields.angle("faced_deg", &C::faced_rad, {0.1, 180.0}, "a heading error within this is faced");
  fields.number("dwell_s", &C::dwell_s, {0.0, 600.0}, "s", "unknown ground is faced for so long");
  fields.number("opening_dwell_s", &C::opening_dwell_s, {0.0, 600.0}, "s", "and an opening for so long");
  fields.angle("sweep_deg", &C::sweep_rad, {0.0, 90.0}, "sweeping the sonars by this to either side meanwhile");
  fields.number("at_most_s", &C::at_most_s, {0.0, 600.0}, "s", "with the turn to it, at most");
}

void ExploreBlockedSettings::describe(Fields<ExploreBlockedSettings>& fields) {
  using C = ExploreBlockedSettings;
  fields.number("patience_s", &C::patience_s, {0.1, 3600.0}, "s", "how long it waits for a blockage to go");
  fields.group("back_up", &C::back_up, "then it backs up");
  fields.number("avoid_for_s", &C::avoid_for_s, {0.0, 1e6}, "s", "paths avoid the place for so long");
  fields.number("failed_again_m", &C::failed_again_m, {0.0, 10.0}, "m",
                "a task whose place is this near to one it was blocked on the way to is given up");
  fields.integer("max_in_a_row", &C::max_in_a_row, {1.0, 1000.0}, "after so many blockages in a row it gives up");
  fields.number("progress_m", &C::progress_m, {0.0, 100.0}, "m", "blockages with this drive between are not in a row");
  fields.number("way_back_m", &C::way_back_m, {0.1, 100.0}, "m",
                "after too many it drives back the way it came, for so much, before it fails");
}

void PassageDriveSettings::describe(Fields<PassageDriveSettings>& fields) {
  using C = PassageDriveSettings;
  fields.numbers(
      "clearances_m", &C::clearances_m, {0.0, 5.0}, "m",
      "room beside the robot with which a passage is tried, one after the other; those that it is too narrow "
      "for by its echoes are left out; [0.1, 0.05, 0.02] unless given");
  fields.numbers("speeds_mps", &C::speeds_mps, {0.001, 5.0}, "m/s",
                 "top speeds of these tries; [0.15, 0.08, 0.05] unless given");
  fields.number("width_error_m", &C::width_error_m, {0.0, 1.0}, "m",
                "a passage may be wider by this than its echoes say: its outermost parts are seldom heard");
  fields.number("past_m", &C::past_m, {0.05, 5.0}, "m", "the drive ends with its edge this far behind the opening");
  fields.number("through_m", &C::through_m, {0.0, 5.0}, "m", "the robot has passed when its edge is this far behind");
  fields.number("arrived_m", &C::arrived_m, {0.001, 1.0}, "m", "this near to the end of the drive is there");
  fields.number("at_most_s", &C::at_most_s, {1.0, 3600.0}, "s", "time for all tries of one drive");
}

void EstimateSettings::describe(Fields<EstimateSettings>& fields) {
  using C = EstimateSettings;
  fields.number("every_s", &C::every_s, {0.1, 3600.0}, "s", "the map is counted this often");
  fields.number("not_before_s", &C::not_before_s, {0.0, 3600.0}, "s", "there is no estimate before");
  fields.number("mark_every_m", &C::mark_every_m, {0.01, 10.0}, "m", "what the robot passes is marked this often");
  fields.number("passed_m", &C::passed_m, {0.1, 50.0}, "m",
                "what it comes nearer to has been passed, when edges are not looked at closer");
}

void ExploringSettings::describe(Fields<ExploringSettings>& fields) {
  using C = ExploringSettings;
  fields.group("choice", &C::choice, "when and where the next task is chosen");
  fields.group("weights", &C::weights, "what tasks are worth, in metres of path");
  fields.group("openings", &C::openings, "openings that look too narrow, and rooms out of reach");
  fields.group("passages", &C::passages, "doors and gaps into what it has not been in");
  fields.group("passage_drive", &C::passage_drive, "driving through them");
  fields.group("known", &C::known, "which share of what can be reached is known");
  fields.group("motion", &C::motion, "how it moves");
  fields.group("face", &C::face, "turning the sonars to what is unknown");
  fields.group("blocked", &C::blocked, "what it does when it is blocked");
  fields.group("estimate", &C::estimate, "how long it still takes, for people");
}

}  // namespace cairn::behaviours
