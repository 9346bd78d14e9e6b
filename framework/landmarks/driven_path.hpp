// Where the robot has been, thinned, and stretches of it between two places.
#pragma once

#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

class DrivenPath {
 public:
  DrivenPath() = default;
  explicit DrivenPath(std::vector<Pose2> poses) : poses_(std::move(poses)) {}

  // Adds a pose that is 5 cm or more from the last one.
  void record(const Pose2& T_map_robot);
  // The shortest stretch between two places that were both passed within 0.25 m, in the direction from -> to, headings
  // turned where it was driven in the other direction; its ends are the places themselves. Empty when there is none.
  // O(poses).
  [[nodiscard]] std::vector<Pose2> between(const Pose2& from, const Pose2& to) const;

  [[nodiscard]] const std::vector<Pose2>& poses() const { return poses_; }

 private:
  std::vector<Pose2> poses_;
};

// The same poses from the last to the first, each turned round.
[[nodiscard]] std::vector<Pose2> reversed(std::vector<Pose2> path);

}  // namespace cairn
