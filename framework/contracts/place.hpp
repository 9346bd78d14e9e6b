// A place on a map, as an end of a path.
#pragma once

#include <optional>
#include <vector>

#include "maps/geometry/pose.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// A pose, or any one of some landmarks. With neither the place is unknown.
struct Place {
  std::optional<Pose2> pose;
  bool heading_matters = false;  // of the pose; otherwise its theta is ignored
  std::vector<LandmarkId> landmarks;
};

}  // namespace cairn
