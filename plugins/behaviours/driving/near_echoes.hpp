// What has echoed from near is solid, what echoes have passed through from near is free.
//
// Smooth walls bounce a slanting beam away, and the long reading that comes instead wipes them out of an
// occupancy grid; the width of a beam draws arcs beside everything that is seen from afar. Near echoes along
// the middle of a beam are the trustworthy part of a sonar, and better still is where the robot has stood:
// both outvote the map. Only echoes count here, never silence.
#pragma once

#include <vector>

#include "framework/contracts/observation.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn::behaviours {

inline constexpr int kMaxSensors = 4096;  // an index beyond it is an error of the source, not a transducer

class NearEchoes {
 public:
  // Cells as those of the map.
  explicit NearEchoes(const OccupancyGrid& map);

  // A reading counts when its transducer has moved since the last one that did.
  void see(const Observation& observation, const Pose2& T_map_robot);
  // Where the robot stands is free.
  void stand_at(const Point& p_map, double radius_m);

  [[nodiscard]] bool is_solid(Cell cell) const;
  [[nodiscard]] bool is_conservatively_free(Cell cell) const;
  // What the map says where the votes do not know better.
  [[nodiscard]] bool is_occupied(const OccupancyGrid& map, Cell cell) const {
    return is_solid(cell) || (map.state(cell) == CellState::occupied && !is_conservatively_free(cell));
  }
  // A copy of this part of the map with the votes applied.
  [[nodiscard]] OccupancyGrid applied_to(const OccupancyGrid& map, const CellBox& part) const;

 private:
  void vote(const RangeReading& reading, const Pose2& T_map_sensor);

  OccupancyGrid votes_;
  std::vector<Pose2> last_voted_;  // T_map_sensor, by transducer
};

}  // namespace cairn::behaviours
