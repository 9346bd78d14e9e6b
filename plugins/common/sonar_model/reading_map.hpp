// What maps share that take each reading on its own: the grid, its changes, and the room of the robot itself.
#pragma once

#include <algorithm>
#include <vector>

#include "framework/contracts/mapper.hpp"
#include "maps/grid/beam_cells.hpp"
#include "plugins/common/sonar_model/cleared_footprint.hpp"

namespace cairn::sonar_model {

class ReadingMap : public Mapper {
 public:
  // The spans cover the cells whose log-odds really changed. Ignores an observation under a pose that is not finite.
  // O(cells in the beams).
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override;
  [[nodiscard]] const OccupancyGrid& grid() const override { return grid_; }
  void begin_with(const OccupancyGrid& grid) { grid_ = grid; }
  // Whose room is free where it stands.
  void clear_under(const RobotModel& robot) { cleared_footprint_ = ClearedFootprint(robot); }

 protected:
  explicit ReadingMap(OccupancyGrid grid) : grid_(std::move(grid)) {}

  virtual void integrate_reading(const RangeReading& reading, const Pose2& T_map_robot) = 0;

  // Adds increment_of(place) to the log-odds of every cell inside of the beam; nothing when the beam leaves what a grid
  // can hold.
  template <class IncrementOf>
  void add_beam(const Beam& beam, const IncrementOf& increment_of) {
    if (!grid_.can_include(beam.T_map_sensor.position(), beam.reach_m)) return;
    const BeamFrame frame(beam, grid_.cell_m());
    spans_over(beam, grid_.cell_m(), spans_);
    for (const CellSpan& span : spans_) {
      CellSpan moved{span.y, span.x_end, span.x_end};
      for (int x = span.x_begin; x < span.x_end; ++x) {
        const Cell cell{x, span.y};
        const BeamPlace place = frame.place_of(cell);
        const int increment = place.is_inside ? increment_of(place) : 0;
        if (increment == 0 || !grid_.add_log_odds(cell, increment)) continue;  // 0 must not grow the grid
        moved.x_begin = std::min(moved.x_begin, x);
        moved.x_end = x + 1;
      }
      if (moved.x_begin < moved.x_end) changes_.spans.push_back(moved);
    }
  }

 private:
  OccupancyGrid grid_;
  CellChanges changes_;  // of the latest call
  ClearedFootprint cleared_footprint_;
  std::vector<CellSpan> spans_;  // kept for its memory only
};

}  // namespace cairn::sonar_model
