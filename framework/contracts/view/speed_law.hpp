// How fast a robot may go beside an obstacle: the one law of the collision monitor, the controllers and the planners.
//
// The collision monitor stops what would come nearer than its margin, down to a creep; in its slow zone beyond that it
// lets through a share of the top speed. The default controller goes slower where only its tight clearance is left.
// Each of them fills in its own zones and asks allowed_speed_mps(); planners take the zones of both, and count what a
// metre takes by DrivingPace.
#pragma once

#include <array>

namespace cairn {

// Clearances are those between the robot's edge and the obstacle.
struct SpeedLaw {
  double margin_m = 0.05;   // stop zone: nearer, the robot creeps
  double creep_mps = 0.04;  // a touch at this speed does no harm
  double slow_m = 0.1;      // slow zone, beyond the margin
  double slow_ratio = 0.4;  // of the robot's top speed, in the slow zone
  double tight_m = 0.07;    // nearer, the controller goes at tight_mps at most
  double tight_mps = 0.12;
  double spread_m = 0.1;  // a planned clearance may be off by so much: the map, the pose, the path as it is driven
};

// Never falls with the clearance, and never above max_v_mps.
[[nodiscard]] double allowed_speed_mps(double clearance_m, double max_v_mps, const SpeedLaw& law);

// Seconds that a metre takes where the robot is planned to keep a clearance: the mean of 1 / allowed_speed_mps() over
// the clearances within spread_m of the planned one. Continuous, never rises with the clearance.
class DrivingPace {
 public:
  // top_mps: as fast as the path is to be driven, within max_v_mps; 0: max_v_mps. Speeds must be above 0.
  DrivingPace(const SpeedLaw& law, double max_v_mps, double top_mps = 0.0);

  [[nodiscard]] double s_per_m(double clearance_m) const {
    double pace = open_s_per_m_;
    for (const Zone& zone : zones_) {
      const double nearer_m = zone.below_m - clearance_m + spread_m_;
      if (nearer_m <= 0.0) break;  // the widest zone comes first
      pace += nearer_m >= 2.0 * spread_m_ ? zone.extra_s_per_m : zone.extra_s_per_m * nearer_m / (2.0 * spread_m_);
    }
    return pace;
  }
  // In the open; no metre takes less.
  [[nodiscard]] double min_s_per_m() const { return open_s_per_m_; }
  // From here on, more clearance gains nothing.
  [[nodiscard]] double open_from_m() const { return zones_.front().below_m + spread_m_; }

 private:
  struct Zone {
    double below_m = 0.0;
    double extra_s_per_m = 0.0;  // on top of that of the next wider zone
  };
  double spread_m_;
  double open_s_per_m_;
  std::array<Zone, 3> zones_;
};

}  // namespace cairn
