// Distance to the nearest cell that cannot be crossed, and shortest cell-to-cell travel over what can.
#pragma once

#include <cstdint>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

enum class UnknownPolicy : std::uint8_t { avoid, allow };

// Exact Euclidean distance from cell centre to the nearest blocked cell's centre, over a box.
//
// What lies outside the box is unknown. It blocks when unknown space is avoided (the box's own rim
// is unknown then, so distances inside are those of the endless plane). When unknown space is
// allowed it repels nothing, yet cannot be entered: distance_m() is 0 there all the same. A field
// without any blocked cell holds the box's diagonal everywhere; one of an empty grid has no cells.
// O(cells) to build.
class DistanceField {
 public:
  DistanceField() = default;
  // Over grid.bounds() grown by one cell. Occupied cells are blocked; unknown ones by policy.
  DistanceField(const OccupancyGrid& grid, UnknownPolicy unknown, const OccupancyThresholds& thresholds = {});

  // Over a box: not 0 is free, row-major, lower left cell first.
  DistanceField(const CellBox& box, double cell_m, const Point& origin_m, std::vector<std::uint8_t> free);

  // Follows a grid that differs from the one it was made of, by the same rules, within `changed` only: looks only at
  // what that may concern, and holds what a field made anew would, to the bit. Made anew where the bounds differ.
  void follow(const OccupancyGrid& grid, UnknownPolicy unknown, const OccupancyThresholds& thresholds,
              const CellBox& changed);

  [[nodiscard]] CellBox box() const { return box_; }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] Point origin_m() const { return origin_m_; }
  [[nodiscard]] Cell cell_at(const Point& p_map) const;
  [[nodiscard]] Point centre_of(Cell cell) const;
  // Metres between cell centres; 0 on blocked cells and outside the box.
  [[nodiscard]] float distance_m(Cell cell) const {
    if (!box_.contains(cell)) return 0.0F;
    return distance_m_[static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
                       static_cast<std::size_t>(cell.x - box_.min.x)];
  }
  [[nodiscard]] bool is_blocked(Cell cell) const { return distance_m(cell) <= 0.0F; }
  // A lower bound of the distance from any point of the point's cell to any point of a blocked cell:
  // distance_m less one cell diagonal, never below 0.
  [[nodiscard]] double clearance_m(const Point& p_map) const;

 private:
  void measure(std::vector<std::uint8_t> free);
  [[nodiscard]] CellBox concerned_by(const CellBox& changed) const;
  [[nodiscard]] bool measure_within(const CellBox& cells, const CellBox& window, std::vector<std::uint8_t> free);

  CellBox box_;
  double cell_m_ = 0.05;
  Point origin_m_{0.0, 0.0};
  std::vector<float> distance_m_;
};

}  // namespace cairn
