// What is measured of tags in pictures, and the tables of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/marker.hpp"
#include "plugins/common/camera/lens.hpp"

namespace cairn {

struct PoseError {
  double position_m = 0.0;
  double direction_rad = 0.0;  // signed
  bool is_flipped = false;     // it is nearer to the pose that is turned to the other side of the line of sight
};

// An error over its standard deviation, in the axes of the line of sight.
struct Normalized {
  double along = 0.0;
  double across = 0.0;
  double direction = 0.0;
  double nees = 0.0;
};

// One tag within sight of one picture.
struct TagSample {
  int home = 0;
  double distance_m = 0.0;
  double slant_rad = 0.0;
  bool is_found = false;
  // Where it is found:
  bool keeps_two = false;
  PoseError ours;         // of the pose that fits better
  PoseError ours_kept;    // the better one by the truth, where two are kept
  PoseError raw;          // of libapriltag
  Normalized with_floor;  // of ours_kept, as the module says it
  Normalized of_corners;  // the same by the corners' noise alone
};

[[nodiscard]] PoseError error_of(const Pose2& T_robot_marker, const Pose2& truth, const Point& eye_m);
[[nodiscard]] Normalized normalized(const MarkerPose& pose, const Pose2& truth, const Point& eye_m);

[[nodiscard]] std::string found_table(const std::vector<TagSample>& samples);
[[nodiscard]] std::string errors_table(const std::vector<TagSample>& samples);
[[nodiscard]] std::string sides_table(const std::vector<TagSample>& samples);
[[nodiscard]] std::string coverage_table(const std::vector<TagSample>& samples);

}  // namespace cairn
