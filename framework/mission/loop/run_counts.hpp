// What a run counts as its observations come.
#pragma once

#include <cstdint>

#include "framework/contracts/observation.hpp"

namespace cairn {

struct RunFigures {
  std::int64_t readings = 0;
  std::int64_t matchings = 0;
  std::int64_t collisions = 0;
  double distance_m = 0.0;  // by the odometry
};

class RunCounts {
 public:
  // Goes on from there.
  void restore(const RunFigures& figures) { figures_ = figures; }

  // Whether the robot has begun to touch something.
  bool count(const Observation& observation);
  void count_matchings(std::int64_t matchings) { figures_.matchings += matchings; }
  [[nodiscard]] const RunFigures& figures() const { return figures_; }

 private:
  RunFigures figures_;
  bool has_begun_ = false;
  bool was_bumped_ = false;
  Pose2 T_odom_last_;
};

}  // namespace cairn
