// Settings of the collision monitor, and how long it has interfered.
#pragma once

#include <optional>

#include "framework/config/fields.hpp"

namespace cairn {

struct CollisionMonitorConfig {
  double margin_m = 0.05;         // kept between the footprint and anything seen
  double slow_m = 0.1;            // beyond the margin: only slowly
  double stale_s = 1.0;           // how long an echo counts, and how long a transducer may be silent
  std::optional<double> blind_s;  // without any reading for so long, no driving; none: one and a half periods of them
  double command_valid_s = 0.25;  // the wheels stop by themselves so long after the last command
  double stop_after_s = 0.25;     // and are stopped when no tick has ended for so long, by the wall clock
  static void describe(Fields<CollisionMonitorConfig>& fields);
};

// How long it has interfered.
struct CollisionMonitorFigures {
  double slowed_s = 0.0;   // cut the speed, for what was seen or because nobody looked
  double stopped_s = 0.0;  // let nothing of it through, for what was seen
  double stale_s = 0.0;    // wanted to drive without fresh readings
};

}  // namespace cairn
