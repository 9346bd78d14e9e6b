#include "plugins/common/sonar_model/reading_map.hpp"

#include "maps/geometry/segments.hpp"
#include "plugins/common/sonar_model/reading.hpp"

namespace cairn::sonar_model {

const CellChanges& ReadingMap::integrate(const Observation& observation, const PoseEstimate& pose) {
  changes_.spans.clear();
  if (!is_finite(pose.T_map_robot)) return changes_;
  for (const RangeReading& reading : observation.ranges) integrate_reading(reading, pose.T_map_robot);
  const std::size_t beams = changes_.spans.size();
  cleared_footprint_.take(grid_, pose.T_map_robot, changes_.spans);
  const bool is_one_beam = observation.ranges.size() <= 1 && changes_.spans.size() == beams;
  if (!is_one_beam) tidy(changes_.spans);
  return changes_;
}

}  // namespace cairn::sonar_model
