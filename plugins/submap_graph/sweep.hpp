// A scan of a laser that turns while observations come: its parts, each seen from somewhat elsewhere, put together by
// odometry.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn::submap_graph {

class Sweep {
 public:
  // duration_s: of one round; 0: each observation is a whole scan.
  explicit Sweep(double duration_s) : duration_s_(duration_s) {}

  // A part as seen from the robot. Whether the round is complete with it.
  [[nodiscard]] bool add(std::span<const Point> points_m, const Pose2& T_odom_robot, double stamp_s);
  // When it is: all of it, as seen from where the robot is now; the next round begins. Valid until the next call.
  [[nodiscard]] std::span<const Point> take();

 private:
  double duration_s_;
  std::optional<double> begun_s_;  // the end of the round before
  Pose2 T_odom_robot_;
  double stamp_s_ = 0.0;
  std::vector<Point> points_odom_m_;
  std::vector<Point> points_m_;
};

}  // namespace cairn::submap_graph
