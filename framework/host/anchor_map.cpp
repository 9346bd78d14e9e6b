#include "framework/host/anchor_map.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr int kMargin_cells = 64;  // room to grow into
constexpr double kRaySpacing_rad = radians(2.5);

bool any_occupied_near(const OccupancyGrid& grid, Cell cell, int around) {
  for (int y = cell.y - around; y <= cell.y + around; ++y)
    for (int x = cell.x - around; x <= cell.x + around; ++x)
      if (grid.state({x, y}) == CellState::occupied) return true;
  return false;
}

}  // namespace

void AnchorMap::cover(const OccupancyGrid& grid) {
  cell_m_ = grid.cell_m();
  origin_m_ = grid.origin_m();
  const CellBox wanted = grid.bounds();
  if (united(wanted, box_) == box_) return;
  const CellBox box = united(box_, wanted).grown(kMargin_cells);
  std::vector<AnchorCell> cells(static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height()));
  for (int y = box_.min.y; y < box_.max.y; ++y)
    std::copy_n(&at({box_.min.x, y}), box_.width(),
                cells.begin() + static_cast<std::ptrdiff_t>(y - box.min.y) * box.width() + (box_.min.x - box.min.x));
  cells_ = std::move(cells);
  box_ = box;
}

void AnchorMap::follow(const OccupancyGrid& grid, const Point& robot_m, double reach_m, double time_s) {
  if (grid.bounds().empty()) return;
  cover(grid);
  const Point reach(reach_m, reach_m);
  const CellBox around{grid.cell_at(robot_m - reach), grid.cell_at(robot_m + reach)};
  const CellBox box = intersected(around, grid.bounds());
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) look_at(grid, {x, y}, time_s);
}

void AnchorMap::look_at(const OccupancyGrid& grid, Cell cell, double time_s) {
  AnchorCell& mine = at(cell);
  const LogOdds log_odds = grid.log_odds(cell);
  if (log_odds > rules_.occupied_above) {
    mine.freed = 0;
    if (mine.occupied_since_s < 0.0F) mine.occupied_since_s = static_cast<float>(time_s);
    if (mine.anchored || time_s - mine.occupied_since_s < rules_.settled_s || is_beside_old(cell, time_s)) return;
    mine.anchored = true;
    mine.anchored_s = static_cast<float>(time_s);
    ++count_;
    return;
  }
  mine.occupied_since_s = -1.0F;
  if (!mine.anchored) return;
  const bool is_freed = log_odds < 0 && !any_occupied_near(grid, cell, rules_.beside_cells);
  mine.freed = is_freed ? static_cast<std::uint8_t>(mine.freed + 1) : std::uint8_t{0};
  if (mine.freed < rules_.freed_looks) return;
  mine = {};
  --count_;
}

bool AnchorMap::is_beside_old(Cell cell, double time_s) const {
  const int around = rules_.beside_cells;
  const CellBox box = intersected({cell, {cell.x + 1, cell.y + 1}}, box_).grown(around);
  const CellBox near = intersected(box, box_);
  for (int y = near.min.y; y < near.max.y; ++y)
    for (int x = near.min.x; x < near.max.x; ++x) {
      const AnchorCell& other = at({x, y});
      if (other.anchored && time_s - other.anchored_s > rules_.fresh_s) return true;
    }
  return false;
}

void AnchorMap::take_all(const OccupancyGrid& grid) {
  if (grid.bounds().empty()) return;
  cover(grid);
  const CellBox box = grid.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) {
      if (grid.log_odds({x, y}) <= rules_.occupied_above || at({x, y}).anchored) continue;
      at({x, y}).anchored = true;
      at({x, y}).occupied_since_s = at({x, y}).anchored_s = 0.0F;
      ++count_;
    }
}

// Cell by cell (Amanatides and Woo 1987).
std::optional<double> AnchorMap::cast(const Point& from_m, const Point& direction, double reach_m) const {
  const Point at_cells = (from_m - origin_m_) / cell_m_;
  Cell cell{static_cast<int>(std::floor(at_cells.x())), static_cast<int>(std::floor(at_cells.y()))};
  const int step_x = direction.x() > 0.0 ? 1 : -1;
  const int step_y = direction.y() > 0.0 ? 1 : -1;
  const double each_x = std::abs(direction.x()) > 1e-12 ? 1.0 / std::abs(direction.x()) : 1e12;
  const double each_y = std::abs(direction.y()) > 1e-12 ? 1.0 / std::abs(direction.y()) : 1e12;
  double next_x = (step_x > 0 ? cell.x + 1 - at_cells.x() : at_cells.x() - cell.x) * each_x;
  double next_y = (step_y > 0 ? cell.y + 1 - at_cells.y() : at_cells.y() - cell.y) * each_y;
  double entered = 0.0;
  const double reach = reach_m / cell_m_;
  while (entered < reach) {
    const double left = std::min(next_x, next_y);
    if (is_anchor(cell)) return 0.5 * (entered + left) * cell_m_;
    entered = left;
    if (next_x < next_y) {
      cell.x += step_x;
      next_x += each_x;
    } else {
      cell.y += step_y;
      next_y += each_y;
    }
  }
  return std::nullopt;
}

std::optional<AnchorHit> AnchorMap::nearest(const Pose2& T_map_sensor, double half_beam_rad, double reach_m) const {
  std::optional<AnchorHit> nearest;
  const int to_side = std::max(1, static_cast<int>(std::ceil(half_beam_rad / kRaySpacing_rad)));
  for (int i = -to_side; i <= to_side; ++i) {
    const double bearing_rad = half_beam_rad * i / to_side;
    const double angle_rad = T_map_sensor.theta_rad + bearing_rad;
    const Point direction(std::cos(angle_rad), std::sin(angle_rad));
    const auto hit_m = cast(T_map_sensor.position(), direction, nearest ? nearest->range_m : reach_m);
    if (hit_m && (!nearest || *hit_m < nearest->range_m)) nearest = AnchorHit{*hit_m, bearing_rad};
  }
  return nearest;
}

}  // namespace cairn
