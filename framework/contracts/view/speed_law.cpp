#include "framework/contracts/view/speed_law.hpp"

#include <algorithm>

namespace cairn {

double allowed_speed_mps(double clearance_m, double max_v_mps, const SpeedLaw& law) {
  double speed_mps = max_v_mps;
  if (clearance_m < law.margin_m + law.slow_m) speed_mps = std::min(speed_mps, law.slow_ratio * max_v_mps);
  if (clearance_m < law.tight_m) speed_mps = std::min(speed_mps, law.tight_mps);
  if (clearance_m < law.margin_m) speed_mps = std::min(speed_mps, law.creep_mps);
  return speed_mps;
}

DrivingPace::DrivingPace(const SpeedLaw& law, double max_v_mps, double top_mps) : spread_m_(law.spread_m) {
  const double asked_mps = top_mps > 0.0 ? std::min(top_mps, max_v_mps) : max_v_mps;
  open_s_per_m_ = 1.0 / asked_mps;
  std::array<double, 3> rims_m{law.margin_m + law.slow_m, law.tight_m, law.margin_m};
  std::ranges::sort(rims_m, std::ranges::greater{});
  double wider_s_per_m = open_s_per_m_;
  for (std::size_t i = 0; i < rims_m.size(); ++i) {
    // Just inside the rim, and outside the next.
    const double next_m = i + 1 < rims_m.size() ? rims_m[i + 1] : rims_m[i] - 1.0;
    const double s_per_m = 1.0 / std::min(asked_mps, allowed_speed_mps(0.5 * (rims_m[i] + next_m), max_v_mps, law));
    zones_[i] = {rims_m[i], rims_m[i] > next_m ? s_per_m - wider_s_per_m : 0.0};
    if (rims_m[i] > next_m) wider_s_per_m = s_per_m;
  }
}

}  // namespace cairn
