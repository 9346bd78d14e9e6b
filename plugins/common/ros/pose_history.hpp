// Where the odometry was at a moment of the last seconds.
#pragma once

#include <deque>
#include <optional>

#include "maps/geometry/pose.hpp"

namespace cairn::ros {

class PoseHistory {
 public:
  // Stamps must not go back; one that does forgets what was before.
  void add(double stamp_s, const Pose2& T_odom_robot);
  // Between two of them, or the nearest at the ends; none when nothing is known.
  [[nodiscard]] std::optional<Pose2> at(double stamp_s) const;

 private:
  struct Known {
    double stamp_s = 0.0;
    Pose2 T_odom_robot;
  };
  std::deque<Known> known_;
};

}  // namespace cairn::ros
