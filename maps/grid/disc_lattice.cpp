#include "maps/grid/disc_lattice.hpp"

#include <algorithm>
#include <numbers>

#include "maps/geometry/segments.hpp"
#include "maps/grid/swept_disc.hpp"

namespace cairn {
namespace {

constexpr double kDoubt_m = 1e-5;   // what rounding of distances may be off by
constexpr std::int32_t kFits = -1;  // in a part without a number yet

// Which stretches between cell centres a disc may drive, decided by centres of cells where these are enough.
class Clearance {
 public:
  Clearance(const DistanceField& space, double radius_m)
      : space_(space),
        squares_{space.origin_m(), space.cell_m()},
        radius_m_(radius_m),
        touching_m_(radius_m + space.cell_m() / 2 - kDoubt_m),
        clear_m_(radius_m + std::numbers::sqrt2 * space.cell_m() / 2 + kDoubt_m) {}

  // tighter_m: the lower of the distances of both cells to what is blocked; length_m: from one to the other.
  [[nodiscard]] bool is_free(Cell from, Cell to, double tighter_m, double length_m) const {
    if (tighter_m < touching_m_) return false;
    if (tighter_m - length_m / 2 > clear_m_) return true;
    const Point a = space_.centre_of(from);
    const Point b = space_.centre_of(to);
    return !any_cell_near(squares_, a, b, std::max(radius_m_, kMinRadius_m), [&](Cell cell) {
      if (!space_.is_blocked(cell)) return false;
      const Point centre = space_.centre_of(cell);
      const double distance_m = distance_to_segment_m(centre, a, b);
      if (distance_m < touching_m_) return true;
      if (distance_m > clear_m_) return false;
      return distance_to_square_m(a, b, centre, squares_.cell_m) < std::max(radius_m_, kMinRadius_m);
    });
  }

 private:
  const DistanceField& space_;
  Lattice squares_;
  double radius_m_;
  double touching_m_;  // a blocked centre nearer than this: the disc touches its cell
  double clear_m_;     // farther: it does not
};

}  // namespace

DiscLattice::DiscLattice(const DistanceField& space, double radius_m)
    : box_(space.box()), cell_m_(space.cell_m()), radius_m_(radius_m) {
  if (box_.empty()) return;
  const auto cells = static_cast<std::size_t>(box_.width()) * static_cast<std::size_t>(box_.height());
  steps_.assign(cells, 0);
  parts_.assign(cells, 0);
  const Clearance clearance(space, radius_m);
  for (int y = box_.min.y; y < box_.max.y; ++y)
    for (int x = box_.min.x; x < box_.max.x; ++x)
      if (!space.is_blocked({x, y}) && clearance.is_free({x, y}, {x, y}, space.distance_m({x, y}), 0.0))
        parts_[index_of({x, y})] = kFits;
  // Steps to later cells, for both of their ends.
  for (int y = box_.min.y; y < box_.max.y; ++y)
    for (int x = box_.min.x; x < box_.max.x; ++x)
      for (int step = 4; step < 8 && fits({x, y}); ++step) {
        const Cell to = Cell{x, y} + kSteps[step];
        const double length_m = kSteps[step].x != 0 && kSteps[step].y != 0 ? std::numbers::sqrt2 * cell_m_ : cell_m_;
        if (!fits(to)) continue;
        const double tighter_m = std::min(space.distance_m({x, y}), space.distance_m(to));
        if (!clearance.is_free({x, y}, to, tighter_m, length_m)) continue;
        steps_[index_of({x, y})] |= static_cast<std::uint8_t>(1 << step);
        steps_[index_of(to)] |= static_cast<std::uint8_t>(1 << (7 - step));
      }
  number_parts();
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
