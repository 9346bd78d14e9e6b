#include "plugins/common/logs/range_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::log_common {

double range_from(double value, double metres_per_unit, const std::vector<double>& no_echo, double min_m,
                  double max_m) {
  constexpr double infinite_m = std::numeric_limits<double>::infinity();
  if (std::find(no_echo.begin(), no_echo.end(), value) != no_echo.end()) return infinite_m;
  if (std::isnan(value) || (value < 0.0 && !std::isinf(value))) return std::numeric_limits<double>::quiet_NaN();
  const double range_m = value * metres_per_unit;
  if (range_m < min_m) return -infinite_m;
  return range_m > max_m ? infinite_m : range_m;
}

}  // namespace cairn::log_common
