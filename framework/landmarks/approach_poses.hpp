// Where a robot stands to be at a landmark.
#pragma once

#include "framework/landmarks/driven_path.hpp"
#include "maps/grid/disc_lattice.hpp"
#include "maps/grid/distance_field.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// An approach pose is the centre of a cell within this of the landmark's position.
inline constexpr double kApproachReach_m = 1.5;

// The known free ground, and where a robot that stands still keeps its margin.
struct StandingGround {
  const DistanceField& space;
  const DiscLattice& lattice;
  double margin_clearance_m = 0.0;  // from the cell's centre to that of the nearest blocked cell

  [[nodiscard]] bool keeps_margin(Cell cell) const {
    const float distance_m = space.distance_m(cell);
    return distance_m > 0.0F && distance_m >= static_cast<float>(margin_clearance_m);
  }
};

// Gives each landmark of level 0 its approach pose, or none where the robot's disc fits at no cell within reach (of a
// printed marker: in front of it).
//
// Where free places near a landmark lie in several parts of the lattice, a part is preferred that the driven path or
// the robot touches; then one with places that keep the margin, then the one with places near most landmarks, then
// that of the approach pose so far, then the nearest. Of that part the nearest place is taken, facing the landmark. An
// approach pose that is no more than 0.1 m farther, and faces it within 5 degrees, stays: routes that lead there do.
void find_approach_poses(LandmarkGraph& graph, const StandingGround& ground, const DrivenPath& driven,
                         const Pose2& T_map_robot);

}  // namespace cairn
