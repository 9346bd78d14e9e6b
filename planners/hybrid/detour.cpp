#include "planners/hybrid/detour.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cairn {
namespace {

// Of the cost; from cluster to cluster, a path within it is shortened first.
double cost_ratio(const SymbolicPath& path, const DetourLimits& limits) {
  return path.leaves_its_cluster ? std::max(limits.detour_ratio, kMaxShortenedRatio) : limits.detour_ratio;
}

std::string more_than_text(double ratio, double direct_min_m) {
  return fmt::format(", more than {:g} times the direct path's lower bound of {}", ratio, metres_text(direct_min_m));
}

}  // namespace

Detour detour_of(const SymbolicPath& path, const DetourLimits& limits) {
  if (path.cost_m <= limits.detour_ratio * limits.direct_min_m) return Detour::none;
  return path.cost_m <= cost_ratio(path, limits) * limits.direct_min_m ? Detour::shortened : Detour::too_long;
}

bool is_short_enough(double shortened_m, const DetourLimits& limits) {
  return shortened_m <= limits.shortened_ratio * limits.direct_min_m;
}

std::string costly_text(double cost_m, double ratio, double direct_min_m) {
  return "directly: over landmarks it costs " + metres_text(cost_m) + more_than_text(ratio, direct_min_m);
}

std::string costly_text(const SymbolicPath& path, const DetourLimits& limits) {
  return costly_text(path.cost_m, cost_ratio(path, limits), limits.direct_min_m);
}

std::string long_text(double shortened_m, const DetourLimits& limits) {
  return "directly: over landmarks it is " + metres_text(shortened_m) + " long with its corners cut" +
         more_than_text(limits.shortened_ratio, limits.direct_min_m);
}

}  // namespace cairn
