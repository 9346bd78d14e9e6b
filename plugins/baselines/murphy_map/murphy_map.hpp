// Mapper for comparison: the sonar model and Bayesian update of a robotics textbook (R. Murphy,
// Introduction to AI Robotics, chapter on map making). With R the model's range, b the half-beam:
//
//   belief(r, a)  = ((R - r) / R + (b - |a|) / b) / 2
//   region I,  |r - D| <= tolerance:  P(occupied) = belief * max_occupied
//   region II, r < D - tolerance:     P(empty)    = belief
//   region III, behind:               nothing
//
// No echo is region II all the way to R. The recursive update of the book is L += ln(P / (1 - P)) from
// an even prior. What a reading means stands in sonar_model/reading.hpp; a ray has (b - |a|) / b = 1.
#pragma once

#include <vector>

#include "framework/contracts/mapper.hpp"
#include "plugins/baselines/murphy_map/config.hpp"
#include "plugins/common/sonar_model/cleared_footprint.hpp"

namespace cairn::murphy_map {

// P(occupied) of one cell from one reading. echo_m: +inf without one. range_m: R of the model.
[[nodiscard]] double occupied_p(const Config& config, double cell_range_m, double bearing_rad, double half_beam_rad,
                                double echo_m, double range_m);

class MurphyMap final : public Mapper {
 public:
  explicit MurphyMap(const Config& config) : config_(config), grid_(config.cell_m, config.clamp_nat) {}

  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override;
  [[nodiscard]] const OccupancyGrid& grid() const override { return grid_; }
  void begin_with(const OccupancyGrid& grid) { grid_ = grid; }
  // Whose room is free where it stands.
  void clear_under(const RobotModel& robot) { cleared_footprint_ = sonar_model::ClearedFootprint(robot); }

 private:
  void integrate_reading(const RangeReading& reading, const Pose2& T_map_robot);

  Config config_;
  OccupancyGrid grid_;
  CellChanges changes_;  // of the latest call
  sonar_model::ClearedFootprint cleared_footprint_;
  std::vector<CellSpan> spans_;  // kept for its memory only
};

}  // namespace cairn::murphy_map
