#include "maps/grid/disc_lattice.hpp"

#include <numbers>

#include "maps/grid/swept_disc.hpp"

namespace cairn {
namespace {

constexpr double kDoubt_m = 1e-5;   // what rounding of distances may be off by
constexpr std::int32_t kFits = -1;  // in a part without a number yet

// Whether the disc touches nothing on a straight line between two cells of which the tighter one is at distance_m,
// centre to centre, from what is blocked.
bool is_free(const DistanceField& space, Cell from, Cell to, double distance_m, double radius_m) {
  const double cell_m = space.cell_m();
  if (distance_m - cell_m / 2 < radius_m - kDoubt_m) return false;
  const Point a = space.centre_of(from);
  const Point b = space.centre_of(to);
  if (distance_m - (std::numbers::sqrt2 * cell_m + (b - a).norm()) / 2 > radius_m + kDoubt_m) return true;
  const Lattice lattice{space.origin_m(), cell_m};
  return !sweep_touches(lattice, a, b, radius_m, [&](Cell cell) { return space.is_blocked(cell); });
}

}  // namespace

DiscLattice::DiscLattice(const DistanceField& space, double radius_m)
    : box_(space.box()), cell_m_(space.cell_m()), radius_m_(radius_m) {
  if (box_.empty()) return;
  const auto cells = static_cast<std::size_t>(box_.width()) * static_cast<std::size_t>(box_.height());
  steps_.assign(cells, 0);
  parts_.assign(cells, 0);
  for (int y = box_.min.y; y < box_.max.y; ++y)
    for (int x = box_.min.x; x < box_.max.x; ++x)
      if (!space.is_blocked({x, y}) && is_free(space, {x, y}, {x, y}, space.distance_m({x, y}), radius_m))
        parts_[index_of({x, y})] = kFits;
  for (int y = box_.min.y; y < box_.max.y; ++y)
    for (int x = box_.min.x; x < box_.max.x; ++x)
      if (fits({x, y})) find_steps(space, {x, y});
  number_parts();
}

// Those to later cells, for both of their ends.
void DiscLattice::find_steps(const DistanceField& space, Cell from) {
  for (int step = 4; step < 8; ++step) {
    const Cell to = from + kSteps[step];
    if (!fits(to)) continue;
    if (!is_free(space, from, to, std::min(space.distance_m(from), space.distance_m(to)), radius_m_)) continue;
    steps_[index_of(from)] |= static_cast<std::uint8_t>(1 << step);
    steps_[index_of(to)] |= static_cast<std::uint8_t>(1 << (7 - step));
  }
}

void DiscLattice::number_parts() {
  std::int32_t parts = 0;
  std::vector<Cell> open;
  for (int y = box_.min.y; y < box_.max.y; ++y)
    for (int x = box_.min.x; x < box_.max.x; ++x) {
      if (parts_[index_of({x, y})] != kFits) continue;
      parts_[index_of({x, y})] = ++parts;
      open.push_back({x, y});
      while (!open.empty()) {
        const Cell from = open.back();
        open.pop_back();
        for (int step = 0; step < 8; ++step) {
          if (!may_step(from, step)) continue;
          std::int32_t& part = parts_[index_of(from + kSteps[step])];
          if (part != kFits) continue;
          part = parts;
          open.push_back(from + kSteps[step]);
        }
      }
    }
}

}  // namespace cairn
