// What has echoed from near stays solid until something echoes from behind it.
//
// Smooth walls bounce a slanting beam away, and the long reading that comes instead wipes them out of an
// occupancy grid. Near echoes along the middle of a beam are the trustworthy part of a sonar: a wall that
// the robot has passed is known, whatever is heard through it later. Only echoes count here, never silence.
#pragma once

#include <vector>

#include "framework/contracts/observation.hpp"
#include "maps/occupancy_grid.hpp"

namespace cairn::behaviours {

class NearEchoes {
 public:
  // Cells as those of the map.
  explicit NearEchoes(const OccupancyGrid& map);

  // A reading counts when its transducer has moved since the last one that did.
  void see(const Observation& observation, const Pose2& T_map_robot);
  // Where the robot stands is free.
  void stand_at(const Point& p_map, double radius_m);

  // Occupied: solid. The rest says nothing.
  [[nodiscard]] const OccupancyGrid& votes() const { return votes_; }
  // A copy of this part of the map with everything solid occupied.
  [[nodiscard]] OccupancyGrid added_to(const OccupancyGrid& map, const CellBox& part) const;

 private:
  void vote(const RangeReading& reading, const Pose2& T_map_sensor);

  OccupancyGrid votes_;
  std::vector<Pose2> last_voted_;  // T_map_sensor, by transducer
};

}  // namespace cairn::behaviours
