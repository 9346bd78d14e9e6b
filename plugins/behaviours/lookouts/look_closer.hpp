// Looking closer: which edges the robot has not been near to, and orbits round free-standing objects.
//
// A landmark is recognised in the gradients along its whole outline (docs/method.md 6), so an object that stands free
// is circled; walls are only passed.
#pragma once

#include <numbers>
#include <span>
#include <vector>

#include "framework/config/fields.hpp"
#include "plugins/behaviours/local_map/free_space.hpp"

namespace cairn::behaviours {

// How near, and how far off the robot's heading, a cell must be for the robot to have seen it well.
struct Sight {
  double within_m = 0.9;
  double to_the_side_rad = std::numbers::pi;
};

// The cells that have not been seen from any pose of the trace. What has been seen is remembered in
// `seen`, which may also hold cells that were given up.
[[nodiscard]] std::vector<Cell> unseen(const FreeSpace& space, const std::vector<Cell>& cells,
                                       const std::vector<Pose2>& trace, const Sight& sight, CellSet& seen);

// What counts as an object that stands free.
struct ObjectSettings {
  int gap_cells = 2;  // sonar leaves holes in outlines; steps over them hold an object together
  int min_cells = 4;
  int max_hidden_sectors = 7;  // behind a wall half of them are
  int min_open_sectors = 9;    // that can be stood in
  double avoid_m = 0.25;
  static void describe(Fields<ObjectSettings>& fields);
};

struct OrbitSettings {
  double distance_m = 0.55;       // from the object's edge to the robot's centre
  double look_closer_m = 0.9;     // a robot within this distance sees the side it is on
  double largest_object_m = 1.5;  // what is longer is a wall
  ObjectSettings object{};
};

// One direction from an object's centre.
enum class SectorState {
  covered,  // the robot has been there and looked
  open,     // it can go there
  blocked,  // something else stands there
  hidden,   // not known yet whether it can
};
struct Sector {
  SectorState state = SectorState::hidden;
  Cell lookout;  // of open sectors
};

inline constexpr int kOrbitSectors = 24;  // anticlockwise from the x axis

struct Orbit {
  Point centre{0.0, 0.0};
  double radius_m = 0.0;        // of the object
  std::vector<Sector> sectors;  // kOrbitSectors

  [[nodiscard]] int count(SectorState state) const;  // 0 when the object was out of reach
  // A thing that stands free, as far as is known: nearly all directions are.
  [[nodiscard]] bool is_round_trip(const ObjectSettings& settings = {}) const;
};

// Groups of occupied cells that fit into largest_object_m.
[[nodiscard]] std::vector<CellGroup> compact_objects(const FreeSpace& space, double largest_object_m,
                                                     const ObjectSettings& settings = {});

// avoid: lookouts within settings.object.avoid_m of these are no lookouts.
[[nodiscard]] Orbit orbit_round(const FreeSpace& space, const CellGroup& object, std::span<const Pose2> trace,
                                const std::vector<Point>& avoid, const OrbitSettings& settings);

// The orbit's cheapest open sector, and the path on through the open sectors next to it, in the direction
// with more of them (towards the robot's heading when equal). Empty when no sector is open.
struct OrbitRoute {
  Cell first;
  double cost_m = 0.0;
  double path_m = 0.0;  // of the path, to the first sector
  std::vector<Point> path;
};
[[nodiscard]] OrbitRoute orbit_route(const FreeSpace& space, const Orbit& orbit, const Pose2& T_map_robot);

}  // namespace cairn::behaviours
