// Mapper: recursive Bayes in log-odds, each reading on its own (docs/method.md 2, 2.1).
//
// Every cell in a reading's beam gets round(256 ln lambda), from its centre's range and bearing, up to
// 3 delta behind the echo, or up to max_m without one. What a reading means stands in
// sonar_model/reading.hpp. Ignored are also a reading whose beam leaves what a grid can hold, and an
// observation under a pose that is not finite. half_beam 0 is a ray.
#pragma once

#include "plugins/baselines/bayes_map/config.hpp"
#include "plugins/common/sonar_model/reading_map.hpp"

namespace cairn::bayes_map {

class BayesMap final : public sonar_model::ReadingMap {
 public:
  explicit BayesMap(const Config& config)
      : ReadingMap(OccupancyGrid(config.cell_m, config.clamp_nat)), beam_model_(config) {}

 private:
  void integrate_reading(const RangeReading& reading, const Pose2& T_map_robot) override;

  sonar_model::BeamModel beam_model_;
};

}  // namespace cairn::bayes_map
