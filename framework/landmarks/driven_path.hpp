// Where the robot has been, thinned, and stretches of it between two places.
//
// The number of poses is bounded. When there are too many, every second one of the older half goes where those beside
// it still show the way: they are at most 0.2 m apart, and it is within 1 cm of the line between them. When that is not
// enough, the oldest are forgotten. The first pose always stays.
#pragma once

#include <cstddef>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

class DrivenPath {
 public:
  static constexpr std::size_t kMaxPoses = 12000;

  explicit DrivenPath(std::size_t max_poses = kMaxPoses) : max_poses_(max_poses) {}
  DrivenPath(std::vector<Pose2> poses, std::size_t max_poses) : poses_(std::move(poses)), max_poses_(max_poses) {}

  // Adds a pose that is 5 cm or more from the last one. Amortised O(1).
  void record(const Pose2& T_map_robot);
  // The shortest stretch between two places that were both passed within 0.25 m, in the direction from -> to, headings
  // turned where it was driven in the other direction; its ends are the places themselves. Empty when there is none.
  // O(poses).
  [[nodiscard]] std::vector<Pose2> between(const Pose2& from, const Pose2& to) const;

  [[nodiscard]] const std::vector<Pose2>& poses() const { return poses_; }

  [[nodiscard]] std::size_t max_poses() const { return max_poses_; }

 private:
  void thin();

  std::vector<Pose2> poses_;
  std::size_t max_poses_;
};

// The same poses from the last to the first, each turned round.
[[nodiscard]] std::vector<Pose2> reversed(std::vector<Pose2> path);

}  // namespace cairn
