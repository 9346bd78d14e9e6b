// The shortest path of a point over a mesh of rectangles: exact, with any heading, round any corner.
//
// The search of Polyanya (M. Cui, D. Harabor, A. Grastien, Compromise-free pathfinding on a navigation
// mesh, IJCAI 2017): best first over intervals of rectangle sides that are seen from the last corner turned at.
#pragma once

#include <functional>
#include <vector>

#include "planners/common/any_angle/cell_mesh.hpp"

namespace cairn {

struct MeshPath {
  std::vector<Point> points;  // lattice coordinates, ends included; between them corners that it turns at. Empty: none
  double length = 0.0;        // in cells
  std::int64_t expanded = 0;  // intervals looked at
  bool interrupted = false;
};

// Ends in lattice coordinates; one in a closed cell has no path. `stop` (optional) is asked every few
// microseconds. A path may touch corners and run along walls. Deterministic; work is bounded by the mesh.
[[nodiscard]] MeshPath shortest_path(const CellMesh& mesh, const Point& from, const Point& to,
                                     const std::function<bool()>& stop = {});

}  // namespace cairn
