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

#include "plugins/baselines/murphy_map/config.hpp"
#include "plugins/common/sonar_model/reading_map.hpp"

namespace cairn::murphy_map {

// P(occupied) of one cell from one reading. echo_m: +inf without one. range_m: R of the model.
[[nodiscard]] double occupied_p(const Config& config, double cell_range_m, double bearing_rad, double half_beam_rad,
                                double echo_m, double range_m);

class MurphyMap final : public sonar_model::ReadingMap {
 public:
  explicit MurphyMap(const Config& config)
      : ReadingMap(OccupancyGrid(config.cell_m, config.clamp_nat)), config_(config) {}

 private:
  void integrate_reading(const RangeReading& reading, const Pose2& T_map_robot) override;

  Config config_;
};

}  // namespace cairn::murphy_map
