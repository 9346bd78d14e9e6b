// How often faults of a simulated robot strike by chance.
#pragma once

#include "framework/config/fields.hpp"

namespace cairn {

// Strikes an hour on average, each kind independent of the others; 0: never.
struct FaultRates {
  double dead = 0.0;
  double stuck = 0.0;
  double slip = 0.0;
  double compass_jump = 0.0;
  double silent = 0.0;
  double kidnap = 0.0;
  double deaf = 0.0;
  static void describe(Fields<FaultRates>& fields);
};

}  // namespace cairn
