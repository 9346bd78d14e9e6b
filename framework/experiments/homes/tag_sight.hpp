// Which tags a camera has within sight, by the truth.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/world.hpp"

namespace cairn {

struct SightLimits {
  double max_distance_m = 3.0;
  double max_slant_rad = radians(60.0);
};

struct TagSighted {
  double distance_m = 0.0;  // of the tag's centre from the lens, on the floor plan
  double slant_rad = 0.0;   // between the tag's normal and the line of sight; positive: seen from its right side
};

class TagSight {
 public:
  explicit TagSight(const World& world);

  // Nothing: it is not wholly in the picture with its white border, is hidden by a wall or an object even in part, is
  // seen from behind, or beyond the limits. The lens's distortion is left out: what it moves over the picture's edge
  // counts wrongly.
  [[nodiscard]] std::optional<TagSighted> of(const WorldTag& tag, const CameraModel& camera, const Pose2& T_map_robot,
                                             const SightLimits& limits) const;

 private:
  [[nodiscard]] bool is_free(const Point& from_m, const Point& to_m) const;

  std::vector<std::pair<Point, Point>> faces_m_;
};

}  // namespace cairn
