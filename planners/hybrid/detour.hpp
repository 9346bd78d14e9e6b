// Whether a path over landmarks is taken although a direct one may be shorter (docs/method.md 10.4, step 2).
#pragma once

#include <string>

#include "planners/hybrid/symbolic_path.hpp"

namespace cairn {

struct DetourLimits {
  double detour_ratio = 1.3;     // of what a path over landmarks costs
  double shortened_ratio = 1.1;  // of the length of one from cluster to cluster once its corners are cut
  double direct_min_m = 0.0;     // no direct path is shorter
};
// From cluster to cluster, of the cost: a longer one is not worth the work of walking and shortening it.
inline constexpr double kMaxShortenedRatio = 3.0;

enum class Detour {
  none,       // its cost is within detour_ratio
  shortened,  // its length decides, once its corners are cut
  too_long,
};
[[nodiscard]] Detour detour_of(const SymbolicPath& path, const DetourLimits& limits);
[[nodiscard]] bool is_short_enough(double shortened_m, const DetourLimits& limits);

// Why the direct path is taken, as the beginning of a reason: of a path that costs more than so many times the lower
// bound of the direct path, and of one that is longer than shortened_ratio allows.
[[nodiscard]] std::string costly_text(double cost_m, double ratio, double direct_min_m);
[[nodiscard]] std::string costly_text(const SymbolicPath& path, const DetourLimits& limits);
[[nodiscard]] std::string long_text(double shortened_m, const DetourLimits& limits);

}  // namespace cairn
