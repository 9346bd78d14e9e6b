// How far estimated poses are from stated relations between them: the measure of the Freiburg SLAM benchmark (Kuemmerle
// and others, "On measuring the accuracy of SLAM algorithms", Autonomous Robots 2009).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

struct StampedPose {
  double stamp_s = 0.0;
  Pose2 T_map_robot;
};

struct StatedRelation {
  double from_s = 0.0;
  double to_s = 0.0;
  Pose2 T_from_to;
};

struct MeanError {
  double mean = 0.0;
  double deviation = 0.0;  // of the single errors, over their number
  double greatest = 0.0;
};

struct RelationErrors {
  std::size_t used = 0;
  std::size_t without_pose = 0;  // relations of which an end has no pose of its stamp
  MeanError translation_m;
  MeanError rotation_deg;
};

// Of each relation whose two stamps are those of poses, within the tolerance (the nearest pose then): the length and
// the angle of (estimated relation)^-1 (stated relation). No pose is interpolated. O((n + m) log n) for n poses.
[[nodiscard]] RelationErrors relation_errors(std::span<const StatedRelation> relations, std::vector<StampedPose> poses,
                                             double tolerance_s);

}  // namespace cairn
