// The echoes of the last metres of the way, as sensors with few beams need them: a single scan of theirs says little.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn::submap_graph {

class GatheredEchoes {
 public:
  // Keeps the echoes of so much of the way; nothing when that is 0.
  explicit GatheredEchoes(double way_m) : way_m_(way_m) {}

  // A scan as seen from the robot, and where odometry alone puts it.
  void add(std::span<const Point> points_m, const Pose2& T_local_robot);
  // As seen from a pose: all that are kept.
  [[nodiscard]] const std::vector<Point>& all(const Pose2& T_local_node);
  // And those that are new since the last call. Both are valid until the next call.
  [[nodiscard]] const std::vector<Point>& since_last_node(const Pose2& T_local_node);

 private:
  struct Echo {
    Point local_m;
    double driven_m = 0.0;
  };
  [[nodiscard]] const std::vector<Point>& seen_from(const Pose2& T_local_node, std::size_t first);

  double way_m_;
  double driven_m_ = 0.0;
  Pose2 T_local_robot_;
  bool has_pose_ = false;
  std::deque<Echo> echoes_;
  std::size_t fresh_ = 0;  // at the end
  std::vector<Point> seen_m_;
};

}  // namespace cairn::submap_graph
