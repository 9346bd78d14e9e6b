#include "maps/grid/grid_overlay.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace cairn {
namespace {

std::string metres(double value) {
  return fmt::format("{:.9g} m", value);
}

}  // namespace

void check_same_cell_size(const OccupancyGrid& a, const OccupancyGrid& b) {
  if (std::abs(a.cell_m() - b.cell_m()) > 1e-9 * a.cell_m())
    throw std::invalid_argument("their grids have cells of different size, " + metres(a.cell_m()) + " and " +
                                metres(b.cell_m()));
}

Cell cell_under(const OccupancyGrid& a, Cell cell_of_a, const OccupancyGrid& b, const Pose2& T_b_a) {
  const double touching = 1e-6 * b.cell_m();
  return b.cell_at(T_b_a * a.centre_of(cell_of_a) + Point(touching, touching));
}

CellBox box_over(const OccupancyGrid& a, const OccupancyGrid& b, const Pose2& T_a_b) {
  const CellBox bounds = b.bounds();
  CellBox box;
  if (bounds.empty()) return box;
  const Point half(b.cell_m() / 2.0, b.cell_m() / 2.0);
  for (const Cell corner :
       {bounds.min, bounds.max, Cell{bounds.min.x, bounds.max.y}, Cell{bounds.max.x, bounds.min.y}}) {
    const Cell at = a.cell_at(T_a_b * (b.centre_of(corner) - half));
    box = united(box, {at - Cell{1, 1}, at + Cell{2, 2}});
  }
  return box;
}

OccupancyGrid with_evidence_of(const OccupancyGrid& a, const OccupancyGrid& b, const Pose2& T_a_b) {
  if (b.bounds().empty()) return a;
  const bool from_nothing = a.bounds().empty();
  const Point corner = T_a_b * b.origin_m();
  OccupancyGrid sum = from_nothing ? OccupancyGrid(b.cell_m(), b.clamp_nat(), corner) : a;
  check_same_cell_size(sum, b);
  const Pose2 T_b_a = inverse(T_a_b);
  const CellBox box = box_over(sum, b, T_a_b);
  CellBox known;
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (b.log_odds(cell_under(sum, {x, y}, b, T_b_a)) != 0) known = united(known, {{x, y}, {x + 1, y + 1}});
  sum.include(known);
  for (int y = known.min.y; y < known.max.y; ++y)
    for (int x = known.min.x; x < known.max.x; ++x)
      if (const LogOdds more = b.log_odds(cell_under(sum, {x, y}, b, T_b_a)); more != 0) sum.add_log_odds({x, y}, more);
  return sum;
}

}  // namespace cairn
