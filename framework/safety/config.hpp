// Settings of the collision monitor, and how long it has interfered.
#pragma once

#include <optional>

#include "framework/config/fields.hpp"
#include "framework/contracts/view/speed_law.hpp"
#include "maps/geometry/pose.hpp"

namespace cairn {

// When a transducer counts as deaf, and how fast a robot may be that hears nothing.
struct DeafConfig {
  int rounds = 3;                            // "no echo" where one was expected
  int ring_echoes = 4;                       // expected in a row, that no transducer has heard
  double within_m = 2.0;                     // farther echoes are not expected
  double occupied_p = 0.8;                   // of the cells that are to echo
  double max_incidence_rad = radians(15.0);  // off the perpendicular of what is to echo
  double max_pose_m = 0.1;                   // standard deviation of the pose, for an echo to be expected
  double max_heading_rad = radians(5.0);     // the same, of the heading
  double silent_m = 3.0;                     // driven without any echo
  double silent_mps = 0.09;                  // from then on
  static void describe(Fields<DeafConfig>& fields);
};

struct CollisionMonitorConfig {
  double margin_m = SpeedLaw{}.margin_m;  // kept between the footprint and anything seen
  double slow_m = SpeedLaw{}.slow_m;      // beyond the margin: only slowly
  double stale_s = 1.0;                   // how long an echo counts, and how long a transducer may be silent
  std::optional<double> blind_s;  // without any reading for so long, no driving; none: one and a half periods of them
  double command_valid_s = 0.25;  // the wheels stop by themselves so long after the last command
  double stop_after_s = 0.25;     // and are stopped when no tick has ended for so long, by the wall clock
  DeafConfig deaf;
  static void describe(Fields<CollisionMonitorConfig>& fields);

  // With the default controller's zone.
  [[nodiscard]] SpeedLaw speed_law() const;
};

// How long it has interfered.
struct CollisionMonitorFigures {
  double slowed_s = 0.0;   // cut the speed, for what was seen or because nobody looked
  double stopped_s = 0.0;  // let nothing of it through, for what was seen
  double stale_s = 0.0;    // wanted to drive without fresh readings
  double deaf_s = 0.0;     // of slowed_s: because transducers are deaf, or nothing at all was heard for long
};

}  // namespace cairn
