#include "framework/experiments/map_quality.hpp"

#include <cmath>
#include <numbers>

#include "maps/grid/beam_cells.hpp"

namespace cairn {
namespace {

constexpr double kPlaceEvery_m = 0.1;
constexpr double kReach_m = 3.0;
constexpr int kRays = 720;
constexpr int kCircleSides = 72;

std::vector<std::vector<Point>> outlines_of(const WorldObject& object) {
  std::vector<std::vector<Point>> outlines = object.contour.outlines_m(kCircleSides);
  for (std::vector<Point>& corners : outlines) {
    for (Point& corner : corners) corner = object.T_map_object * corner;
    corners.push_back(corners.front());
  }
  return outlines;
}

// ln(1 + e^x) without overflow: the log loss of a cell with log-odds -x that is occupied.
double softplus(double x) {
  return std::max(x, 0.0) + std::log1p(std::exp(-std::abs(x)));
}

struct Sums {
  std::int64_t cells = 0;
  std::int64_t wrong = 0;
  std::int64_t asked = 0;  // of which `wrong` is a part
  double log_loss = 0.0;
  double brier = 0.0;
};

double ratio(double part, std::int64_t of) {
  return of == 0 ? 0.0 : part / static_cast<double>(of);
}

}  // namespace

TrueCells::TrueCells(const World& world, double cell_m, const Point& origin_m) : cell_m_(cell_m), origin_m_(origin_m) {
  box_ = CellBox{cell_on_lattice(world.min_m, origin_m, cell_m),
                 cell_on_lattice(world.max_m, origin_m, cell_m) + Cell{1, 1}}
             .grown(1);
  cells_.resize(static_cast<std::size_t>(box_.width()) * static_cast<std::size_t>(box_.height()));
  for (const WorldWall& wall : world.walls)
    for (std::size_t i = 1; i < wall.points_m.size(); ++i) draw(wall.points_m[i - 1], wall.points_m[i]);
  for (const WorldObject& object : world.objects) {
    for (const std::vector<Point>& corners : outlines_of(object))
      for (std::size_t i = 1; i < corners.size(); ++i) draw(corners[i - 1], corners[i]);
  }
}

std::size_t TrueCells::index_of(Cell cell) const {
  return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
         static_cast<std::size_t>(cell.x - box_.min.x);
}

void TrueCells::draw(const Point& a_map, const Point& b_map) {
  const Point along = b_map - a_map;
  const Point from = a_map - origin_m_;
  const Beam beam{{from.x(), from.y(), std::atan2(along.y(), along.x())}, 0.0, along.norm()};
  const BeamFrame frame(beam, cell_m_);
  std::vector<CellSpan> spans;
  spans_over(beam, cell_m_, spans);
  for (const CellSpan& span : spans)
    for (int x = span.x_begin; x < span.x_end; ++x)
      if (frame.place_of({x, span.y}).is_inside && box_.contains({x, span.y}))
        cells_[index_of({x, span.y})].wall = true;
}

void TrueCells::look_from(const Point& p_map, double reach_m) {
  const double step_m = cell_m_ / 4.0;  // short enough not to slip between two cells of a wall
  for (int i = 0; i < kRays; ++i) {
    const Point direction = Pose2{0.0, 0.0, i * 2.0 * std::numbers::pi / kRays}.direction();
    for (double range_m = 0.0; range_m <= reach_m; range_m += step_m) {
      const Cell cell = cell_on_lattice(p_map + range_m * direction, origin_m_, cell_m_);
      if (!box_.contains(cell)) break;
      TrueCell& seen = cells_[index_of(cell)];
      seen.seen = true;
      if (seen.wall) break;
    }
  }
}

bool TrueCells::wall_within_a_cell(Cell cell) const {
  for (int i = 0; i < 9; ++i)
    if (is_wall(cell + Cell{i % 3 - 1, i / 3 - 1})) return true;
  return false;
}

MapQuality TrueCells::judge(const OccupancyGrid& grid) const {
  Sums wall;
  Sums free;
  const auto occupied = [&](Cell cell) { return grid.state(cell) == CellState::occupied; };
  for (int y = box_.min.y; y < box_.max.y; ++y)
    for (int x = box_.min.x; x < box_.max.x; ++x) {
      const Cell cell{x, y};
      if (!is_seen(cell)) continue;
      const bool is_a_wall = is_wall(cell);
      const double log_odds = grid.log_odds(cell) / kLogOddsPerNat;
      const double p = probability_of(grid.log_odds(cell));
      Sums& sums = is_a_wall ? wall : free;
      ++sums.cells;
      sums.log_loss += softplus(is_a_wall ? -log_odds : log_odds);
      sums.brier += is_a_wall ? (1.0 - p) * (1.0 - p) : p * p;
      if (is_a_wall) {
        ++wall.asked;
        bool found = false;
        for (int i = 0; i < 9; ++i) found = found || occupied(cell + Cell{i % 3 - 1, i / 3 - 1});
        if (!found) ++wall.wrong;
      } else if (!wall_within_a_cell(cell)) {
        ++free.asked;
        if (occupied(cell)) ++free.wrong;
      }
    }
  MapQuality quality;
  quality.wall_cells = wall.cells;
  quality.free_cells = free.cells;
  quality.wall_log_loss = ratio(wall.log_loss, wall.cells);
  quality.free_log_loss = ratio(free.log_loss, free.cells);
  quality.log_loss = (quality.wall_log_loss + quality.free_log_loss) / 2.0;
  quality.brier = (ratio(wall.brier, wall.cells) + ratio(free.brier, free.cells)) / 2.0;
  quality.ghost_ratio = ratio(static_cast<double>(free.wrong), free.asked);
  quality.missed_ratio = ratio(static_cast<double>(wall.wrong), wall.asked);
  return quality;
}

void TruePath::on(const Event& event, const MissionView& view) {
  if (!std::holds_alternative<TickDone>(event) || !view.truth) return;
  const Point at_m = view.truth->T_map_robot.position();
  if (places_m_.empty() || (at_m - places_m_.back()).norm() >= kPlaceEvery_m) places_m_.push_back(at_m);
}

MapQuality map_quality(const OccupancyGrid& grid, const World& world, const std::vector<Point>& path_m) {
  TrueCells truth(world, grid.cell_m(), grid.origin_m());
  for (const Point& p_m : path_m) truth.look_from(p_m, kReach_m);
  return truth.judge(grid);
}

}  // namespace cairn
