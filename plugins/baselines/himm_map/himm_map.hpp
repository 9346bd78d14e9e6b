// Mapper for comparison: histogrammic in-motion mapping (Borenstein and Koren, 1991).
//
// But for those where the robot stands (cleared_footprint.hpp) only cells on the acoustic axis learn anything: the one
// at the echo's range gains `increment`, those before it lose `decrement`, certainties end at 0 and certainty_max.
// Without an echo all lose, up to range_m. A cell's certainty c stands in OG1 as P = (c + 0.5) / (certainty_max + 1), a
// cell never on an axis as unknown. What a reading means stands in sonar_model/reading.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "framework/contracts/mapper.hpp"
#include "plugins/baselines/himm_map/config.hpp"
#include "plugins/common/sonar_model/cleared_footprint.hpp"
#include "plugins/common/sonar_model/tile_map.hpp"

namespace cairn::himm_map {

class HimmMap final : public Mapper {
 public:
  explicit HimmMap(const Config& config);

  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override;
  [[nodiscard]] const OccupancyGrid& grid() const override { return grid_; }
  // Certainties as its values say; a cell that was in the middle of the scale is one never seen.
  void begin_with(const OccupancyGrid& grid);
  // Whose room is free where it stands.
  void clear_under(const RobotModel& robot) { cleared_footprint_ = sonar_model::ClearedFootprint(robot); }
  [[nodiscard]] int certainty(Cell cell) const;

 private:
  void integrate_reading(const RangeReading& reading, const Pose2& T_map_robot);
  void set_certainty(Cell cell, int certainty);
  [[nodiscard]] int growth_at(Cell cell) const;

  Config config_;
  std::vector<LogOdds> log_odds_of_certainty_;
  int free_certainty_;  // of where the robot stands
  OccupancyGrid grid_;
  sonar_model::TileMap<std::array<std::uint8_t, sonar_model::kCellsInTile>> certainties_;
  CellChanges changes_;  // of the latest call
  sonar_model::ClearedFootprint cleared_footprint_;
  std::vector<CellSpan> spans_;  // kept for its memory only
};

}  // namespace cairn::himm_map
