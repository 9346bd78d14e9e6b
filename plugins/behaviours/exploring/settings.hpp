// The settings of exploring that few missions need, in groups.
#pragma once

#include <vector>

#include "framework/config/fields.hpp"
#include "plugins/behaviours/exploring/known_share.hpp"
#include "plugins/behaviours/following/back_up.hpp"
#include "plugins/behaviours/lookouts/openings.hpp"
#include "plugins/behaviours/lookouts/passages.hpp"

namespace cairn::behaviours {

// When and where the next task is chosen.
struct ChoiceSettings {
  double every_s = 2.5;
  double apart_s = 0.5;
  double around_m = 8.0;
  double shut_in_ratio = 0.9;
  int near_trace_cells = 4;
  double narrow_radius_m = 0.12;
  int far_edge_cells = 4;
  double tight_clearance_m = 0.02;
  double there_m = 0.12;
  double trusted_range_m = 3.0;
  static void describe(Fields<ChoiceSettings>& fields);
};

// What tasks are worth, in metres of path.
struct TaskWeights {
  double orbit_bonus_m = 1.5;
  double frontier_bonus_m_per_m = 0.3;
  double max_frontier_bonus_m = 0.8;
  double stay_bonus_m = 0.8;
  double same_m = 0.8;
  int min_orbit_sectors = 2;
  double orbit_from_m = 1.5;
  double max_detour_for_sector_m = 1.0;
  double is_landmark_m = 0.4;
  double max_path_for_edges_m_per_m = 10.0;
  double small_edge_m = 0.6;
  double min_edge_m = 0.3;
  double view_ratio = 0.85;
  double give_up_ratio = 1.3;
  double frontier_view_m = 1.0;
  double frontier_view_rad = radians(60.0);
  double worthwhile_ratio = 0.25;
  static void describe(Fields<TaskWeights>& fields);
};

// How the robot moves while it explores.
struct ExploreMotionSettings {
  double look_around_radps = radians(45.0);
  double look_around_max_turns = 3.0;
  double blocked_ahead_m = 0.8;
  double blocked_clearance_ratio = 0.5;
  double arrived_m = 0.06;
  double on_orbit_m = 0.5;
  double away_s = 0.5;
  double trace_apart_m = 0.1;
  double trace_turn_rad = radians(30.0);
  double moved_m = 0.1;
  static void describe(Fields<ExploreMotionSettings>& fields);
};

// Turning the sonars to what is unknown.
struct ExploreFaceSettings {
  double faced_rad = radians(8.0);
  double dwell_s = 0.6;  // one round of the sonars, about
  double opening_dwell_s = 4.0;
  double sweep_rad = radians(20.0);
  double at_most_s = 8.0;
  static void describe(Fields<ExploreFaceSettings>& fields);
};

// When the robot is blocked while it explores.
struct ExploreBlockedSettings {
  double patience_s = 2.5;
  BackUpSettings back_up{.speed_mps = 0.04, .distance_m = 0.15, .at_most_s = 5.0};
  double avoid_for_s = 60.0;
  double failed_again_m = 0.4;
  int max_in_a_row = 8;
  double progress_m = 0.5;
  double way_back_m = 1.0;
  static void describe(Fields<ExploreBlockedSettings>& fields);
};

// Driving through a passage.
struct PassageDriveSettings {
  std::vector<double> clearances_m{0.10, 0.05, 0.02};
  std::vector<double> speeds_mps{0.15, 0.08, 0.05};
  double width_error_m = 0.12;
  double past_m = 0.4;
  double through_m = 0.2;
  double arrived_m = 0.08;
  double at_most_s = 90.0;
  static void describe(Fields<PassageDriveSettings>& fields);
};

// How long exploring still takes, for people.
struct EstimateSettings {
  double every_s = 5.0;
  double not_before_s = 20.0;  // a look round
  double mark_every_m = 0.25;
  double passed_m = 1.0;
  static void describe(Fields<EstimateSettings>& fields);
};

struct ExploringSettings {
  ChoiceSettings choice;
  TaskWeights weights;
  OpeningSettings openings;
  PassageSettings passages;
  PassageDriveSettings passage_drive;
  KnownShareSettings known;
  ExploreMotionSettings motion;
  ExploreFaceSettings face;
  ExploreBlockedSettings blocked;
  EstimateSettings estimate;
  static void describe(Fields<ExploringSettings>& fields);
};

}  // namespace cairn::behaviours
