// How a map that has been drawn anew lies beside the map before: not as a whole, but as the robot's way has been bent.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

class MapMove {
 public:
  // The robot's poses in the map before and in this one, one for each observation.
  MapMove(std::vector<Pose2> before, std::vector<Pose2> after);

  // What was placed in the map before when the robot was at its pose of that number, as a move to this map.
  [[nodiscard]] Pose2 of_pose(std::size_t number) const { return after_[number] * inverse(before_[number]); }
  // What lay at that place of the map before: as the way near by. O(length of the way).
  [[nodiscard]] Pose2 near(const Point& before_m) const;
  [[nodiscard]] std::size_t poses() const { return after_.size(); }
  [[nodiscard]] const std::vector<Pose2>& after() const { return after_; }

 private:
  std::vector<Pose2> before_;
  std::vector<Pose2> after_;
  std::vector<std::size_t> stations_;  // some distance apart on the way
};

struct MovedPath {
  std::vector<Point> points;  // more than before, where those were far apart
  double bend_m = 0.0;        // see moved_path()
};
// A path of the map before, in this one, and by how much its shape has changed: the farthest that one of its points is
// from where the path would have it, turned and shifted as a whole so that it fits best. O(length of path and way).
[[nodiscard]] MovedPath moved_path(const MapMove& move, std::span<const Point> path);
// One that was bent by more than this is planned anew.
inline constexpr double kMaxBend_m = 0.2;

}  // namespace cairn
