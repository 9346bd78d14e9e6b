// Mapper: recursive Bayes in log-odds, each reading on its own (docs/method.md 2, 2.1).
//
// Every cell in a reading's beam gets round(256 ln lambda), from its centre's range and bearing, up to
// 3 delta behind the echo, or up to max_m without one. What a reading means stands in
// sonar_model/reading.hpp. Ignored are also a reading whose beam leaves what a grid can hold, and an
// observation under a pose that is not finite. half_beam 0 is a ray.
#pragma once

#include "framework/contracts/mapper.hpp"
#include "plugins/baselines/bayes_map/config.hpp"
#include "plugins/common/sonar_model/cleared_footprint.hpp"

namespace cairn::bayes_map {

class BayesMap final : public Mapper {
 public:
  explicit BayesMap(const Config& config);

  // The spans cover the cells whose log-odds really changed. O(cells in the beams).
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override;
  [[nodiscard]] const OccupancyGrid& grid() const override { return grid_; }
  void begin_with(const OccupancyGrid& grid) { grid_ = grid; }
  // Whose room is free where it stands.
  void clear_under(const RobotModel& robot) { cleared_footprint_ = sonar_model::ClearedFootprint(robot); }

 private:
  void integrate_reading(const RangeReading& reading, const Pose2& T_map_robot);

  sonar_model::BeamModel beam_model_;
  OccupancyGrid grid_;
  CellChanges changes_;  // of the latest call
  sonar_model::ClearedFootprint cleared_footprint_;
  std::vector<CellSpan> spans_;  // kept for its memory only
};

}  // namespace cairn::bayes_map
