// What a recorded number means as a range.
#pragma once

#include <vector>

namespace cairn::log_common {

// value: as it stands in the log, in metres_per_unit metres. One of no_echo, or beyond max_m: +inf;
// nearer than min_m: -inf; negative or NaN: NaN (REP-117).
[[nodiscard]] double range_from(double value, double metres_per_unit, const std::vector<double>& no_echo, double min_m,
                                double max_m);

}  // namespace cairn::log_common
