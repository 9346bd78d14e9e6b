// The simulated world as its file describes it (config/worlds/*.yaml). Map frame.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/marker.hpp"
#include "maps/geometry/contour.hpp"
#include "maps/geometry/pose.hpp"

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

struct TimeSpan {
  double begin_s = 0.0;
  double end_s = 0.0;  // no longer then
};

// A leaf that slides: between its ends it is there, or it is not.
struct WorldDoor {
  std::string name;  // may be empty
  Point from_m{0.0, 0.0};
  Point to_m{0.0, 0.0};
  Surface surface = Surface::smooth;
  std::vector<TimeSpan> closed_s;  // in order, apart from each other
  // every_s > 0: instead, for closed_for_s from first_s on and again after each every_s.
  double every_s = 0.0;
  double closed_for_s = 0.0;
  double first_s = 0.0;

  // Whether it is to be closed at that simulated time.
  [[nodiscard]] bool closes_at(double time_s) const {
    if (every_s > 0.0) return time_s >= first_s && std::fmod(time_s - first_s, every_s) < closed_for_s;
    return std::any_of(closed_s.begin(), closed_s.end(),
                       [&](const TimeSpan& span) { return span.begin_s <= time_s && time_s < span.end_s; });
  }
};

enum class Course { there_and_back, round, once };

// Somebody or something that goes along a path by itself and does not turn.
struct WorldMover {
  std::string name;           // may be empty
  Contour contour;            // about the point that goes along the path
  std::vector<Point> path_m;  // at least two, no neighbours the same
  double speed_mps = 0.5;
  double pause_s = 0.0;  // at each point of the path
  Course course = Course::there_and_back;
  double start_s = 0.0;  // until then it stands at the first point
  Surface surface = Surface::rough;
  bool waits = true;     // stops short of the robot; otherwise it comes to touch it
  double keeps_m = 0.3;  // how far from the robot's footprint it stops, when it waits
};

// A marker on a wall or an object. It hides nothing and no range sensor sees it.
struct WorldTag {
  MarkerId marker;
  Pose2 T_map_tag;        // its centre, and the direction that its printed side faces
  double height_m = 0.3;  // of its centre above the floor
  double size_m = 0.16;   // side of the square that its family's pose is measured by
};

struct World {
  Point min_m{0.0, 0.0};
  Point max_m{0.0, 0.0};
  std::vector<WorldWall> walls;
  std::vector<WorldObject> objects;
  std::vector<WorldDoor> doors;
  std::vector<WorldMover> movers;
  std::vector<WorldTag> tags;
};

}  // namespace cairn
