// What the map has held for a while, as it was then: walls and things that a robot can find its place by.
//
// A map module goes on writing while the robot drifts, and what it writes agrees with the drifted pose. So a cell that
// has been occupied for settled_s becomes an anchor and stays where it is, as long as the map does not hold it free.
// Beside an anchor that is older than fresh_s nothing new is anchored: that would be the same wall, drawn again where
// the robot now believes it to be.
#pragma once

#include <optional>
#include <vector>

#include "maps/cell.hpp"
#include "maps/occupancy_grid.hpp"

namespace cairn {

struct AnchorRules {
  LogOdds occupied_above = 355;  // P > 0.8
  double settled_s = 4.0;
  double fresh_s = 20.0;
  int beside_cells = 2;
  int freed_looks = 5;  // in a row that see it free
};

struct AnchorHit {
  double range_m = 0.0;
  double bearing_rad = 0.0;  // from the axis
};

class AnchorMap {
 public:
  explicit AnchorMap(const AnchorRules& rules = {}) : rules_(rules) {}

  // Brings itself in line with the cells within reach_m of the robot; a look. Grid: always the same one.
  void follow(const OccupancyGrid& grid, const Point& robot_m, double reach_m, double time_s);
  // Everything the grid holds occupied now is an anchor (a saved map).
  void take_all(const OccupancyGrid& grid);

  [[nodiscard]] bool is_anchor(Cell cell) const { return box_.contains(cell) && at(cell).anchored; }
  // Along a ray: where it enters the first anchor's surface, which is taken to be in the middle of its cell.
  [[nodiscard]] std::optional<double> cast(const Point& from_m, const Point& direction, double reach_m) const;
  // The nearest anchor in a cone.
  [[nodiscard]] std::optional<AnchorHit> nearest(const Pose2& T_map_sensor, double half_beam_rad, double reach_m) const;
  [[nodiscard]] std::int64_t count() const { return count_; }

 private:
  struct AnchorCell {
    float occupied_since_s = -1.0F;  // < 0: it is not
    float anchored_s = 0.0F;
    std::uint8_t freed = 0;  // looks in a row
    bool anchored = false;
  };
  void cover(const OccupancyGrid& grid);
  void look_at(const OccupancyGrid& grid, Cell cell, double time_s);
  [[nodiscard]] bool is_beside_old(Cell cell, double time_s) const;
  [[nodiscard]] std::size_t index_of(Cell cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
           static_cast<std::size_t>(cell.x - box_.min.x);
  }
  [[nodiscard]] const AnchorCell& at(Cell cell) const { return cells_[index_of(cell)]; }
  [[nodiscard]] AnchorCell& at(Cell cell) { return cells_[index_of(cell)]; }

  AnchorRules rules_;
  CellBox box_;
  double cell_m_ = 0.05;
  Point origin_m_{0.0, 0.0};
  std::vector<AnchorCell> cells_;
  std::int64_t count_ = 0;
};

}  // namespace cairn
