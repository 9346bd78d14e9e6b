// The simulated world as its file describes it (config/worlds/*.yaml). Map frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maps/contour.hpp"
#include "maps/pose.hpp"

namespace cairn {

enum class Surface { smooth, rough };

struct WorldWall {
  std::vector<Point> points_m;  // a polyline
  Surface surface = Surface::smooth;
};

struct WorldObject {
  std::string category;  // empty: an obstacle that no template describes
  Contour contour;
  Pose2 T_map_object;
  Surface surface = Surface::rough;
};

struct World {
  Point min_m{0.0, 0.0};
  Point max_m{0.0, 0.0};
  std::vector<WorldWall> walls;
  std::vector<WorldObject> objects;
};

}  // namespace cairn
