// How good a grid is, cell by cell, against the world that it was made in.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/contracts/world.hpp"
#include "framework/mission/events.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

// Means over the cells that a perfect ranger would have seen from the robot's true path. Wall cells are
// those that a wall's or thing's outline runs through; log_loss and brier are the mean of both kinds.
struct MapQuality {
  std::int64_t wall_cells = 0;
  std::int64_t free_cells = 0;
  double wall_log_loss = 0.0;  // nat
  double free_log_loss = 0.0;
  double log_loss = 0.0;
  double brier = 0.0;
  double ghost_ratio = 0.0;   // free cells called occupied, more than a cell from any wall
  double missed_ratio = 0.0;  // wall cells with nothing called occupied within a cell
};

// The world on the lattice of a grid.
class TrueCells {
 public:
  TrueCells(const World& world, double cell_m, const Point& origin_m);

  [[nodiscard]] bool is_wall(Cell cell) const { return box_.contains(cell) && at(cell).wall; }
  [[nodiscard]] bool is_seen(Cell cell) const { return box_.contains(cell) && at(cell).seen; }
  // Marks what is seen from a place, as far as reach_m and the first wall.
  void look_from(const Point& p_map, double reach_m);
  [[nodiscard]] MapQuality judge(const OccupancyGrid& grid) const;

 private:
  struct TrueCell {
    bool wall = false;
    bool seen = false;
  };
  [[nodiscard]] std::size_t index_of(Cell cell) const;
  [[nodiscard]] const TrueCell& at(Cell cell) const { return cells_[index_of(cell)]; }
  void draw(const Point& a_map, const Point& b_map);
  [[nodiscard]] bool wall_within_a_cell(Cell cell) const;

  double cell_m_;
  Point origin_m_;
  CellBox box_;
  std::vector<TrueCell> cells_;
};

// The robot's true path, a place every 0.1 m.
class TruePath : public Listener {
 public:
  void on(const Event& event, const MissionView& view) override;
  [[nodiscard]] const std::vector<Point>& places_m() const { return places_m_; }

 private:
  std::vector<Point> places_m_;
};

// What sonars see well: as far as 3 m.
[[nodiscard]] MapQuality map_quality(const OccupancyGrid& grid, const World& world, const std::vector<Point>& path_m);

}  // namespace cairn
