#include "planners/common/disc_space/disc_space.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <mutex>
#include <numbers>
#include <stdexcept>

#include "maps/grid/connected_cells.hpp"

namespace cairn {
namespace {

constexpr double kHalfDiagonal = 0.5 * std::numbers::sqrt2;  // of a cell of side 1

constexpr double kFloatNoise = 1e-6;  // of distances, which are kept as float

// A stretch of a segment, in metres from where that begins.
struct Part {
  double begin_m;
  double end_m;
};

// First in, first out, without memory of its own.
class PartQueue {
 public:
  [[nodiscard]] bool is_empty() const { return first_ == end_; }
  // False when it is full.
  bool push(const Part& part) {
    if (end_ - first_ == kMax) return false;
    parts_[end_++ % kMax] = part;
    return true;
  }
  Part pop() { return parts_[first_++ % kMax]; }

 private:
  static constexpr std::size_t kMax = 128;
  std::array<Part, kMax> parts_;
  std::size_t first_ = 0;
  std::size_t end_ = 0;
};

constexpr int floor_divided(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

}  // namespace

// Numbers of connected cells, by row; 0 is blocked.
struct DiscSpace::Parts {
  std::once_flag made;
  std::vector<std::int32_t> numbers;
};

DiscSpace::DiscSpace(const OccupancyGrid& grid, const GroundRules& rules)
    : rules_(rules),
      field_(grid, rules.unknown, rules.thresholds),
      lattice_{grid.origin_m(), grid.cell_m()},
      parts_(std::make_shared<Parts>()) {}

DiscSpace::DiscSpace(const DiscSpace& before, const OccupancyGrid& grid, const CellBox& changed)
    : rules_(before.rules_),
      field_(before.field_),
      lattice_{grid.origin_m(), grid.cell_m()},
      parts_(std::make_shared<Parts>()) {
  field_.follow(grid, rules_.unknown, rules_.thresholds, changed);
}

DiscSpace::DiscSpace(const DiscSpace& coarse, int parts)
    : rules_(coarse.rules_),
      lattice_{coarse.lattice_.origin_m, coarse.lattice_.cell_m / parts},
      parts_(std::make_shared<Parts>()) {
  const CellBox box = coarse.field_.box();
  const CellBox fine{{box.min.x * parts, box.min.y * parts}, {box.max.x * parts, box.max.y * parts}};
  std::vector<std::uint8_t> free;
  free.reserve(static_cast<std::size_t>(fine.width()) * static_cast<std::size_t>(fine.height()));
  for (int y = fine.min.y; y < fine.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      free.insert(free.end(), static_cast<std::size_t>(parts),
                  coarse.is_blocked({x, floor_divided(y, parts)}) ? std::uint8_t{0} : std::uint8_t{1});
  field_ = DistanceField(fine, lattice_.cell_m, lattice_.origin_m, std::move(free));
}

DiscSpace DiscSpace::refined(int parts) const {
  if (parts < 1) throw std::invalid_argument(fmt::format("DiscSpace::refined: parts must be positive, got {}", parts));
  return DiscSpace(*this, parts);
}

bool DiscSpace::contains(const Point& p_map) const {
  // Compared as numbers: the index of a far away or NaN point does not fit an int.
  const Point p_cells = (p_map - lattice_.origin_m) / lattice_.cell_m;
  const CellBox box = field_.box();
  return p_cells.x() >= box.min.x && p_cells.x() < box.max.x && p_cells.y() >= box.min.y && p_cells.y() < box.max.y;
}

DiscSpace::Bounds DiscSpace::bounds_at(const Point& p_map) const {
  // The point is in the box, or outside by what rounding does: there, whole numbers are cut as floor() would.
  const CellBox box = field_.box();
  const Point p_cells = (p_map - lattice_.origin_m) / lattice_.cell_m;
  const Cell cell{box.min.x + std::clamp(static_cast<int>(p_cells.x() - box.min.x), 0, box.width() - 1),
                  box.min.y + std::clamp(static_cast<int>(p_cells.y() - box.min.y), 0, box.height() - 1)};
  const double centres_m = field_.distance_m(cell);
  const double off_m = (p_map - lattice_.centre_of(cell)).norm();
  // A square lies within half its diagonal of its centre, and holds a disc of half its side.
  return {(1.0 - kFloatNoise) * centres_m - off_m - kHalfDiagonal * lattice_.cell_m,
          (1.0 + kFloatNoise) * centres_m + off_m - 0.5 * lattice_.cell_m};
}

bool DiscSpace::nothing_blocks() const {
  const CellBox box = field_.box();
  return field_.distance_m(box.min) >= static_cast<float>(std::hypot(box.width(), box.height()) * lattice_.cell_m);
}

// From the middle outwards: what is blocked shows soon, and what a middle knows to be free is left out of the rest.
bool DiscSpace::fits_along(const Point& from, const Point& to, double radius_m) const {
  if (!contains(from) || !contains(to)) return false;
  const double length_m = (to - from).norm();
  const double reach_m = std::max(radius_m, kMinRadius_m);
  const Point direction = length_m > 0.0 ? Point((to - from) / length_m) : Point(0.0, 0.0);
  const auto at = [&](double s_m) { return s_m < length_m ? Point(from + s_m * direction) : to; };
  const auto touches = [&](const Part& part) {
    return sweep_touches(lattice_, at(part.begin_m), at(part.end_m), radius_m,
                         [this](Cell c) { return is_blocked(c); });
  };
  PartQueue parts;
  PartQueue doubtful;
  parts.push({0.0, length_m});
  while (!parts.is_empty()) {
    const Part part = parts.pop();
    const double middle_m = 0.5 * (part.begin_m + part.end_m);
    const Bounds bounds = bounds_at(at(middle_m));
    if (bounds.max_m < reach_m && !nothing_blocks()) return false;
    double known_m = bounds.min_m - reach_m;
    if (2.0 * known_m < std::min(lattice_.cell_m, part.end_m - part.begin_m) || known_m < 0.0) {  // too close to decide
      known_m = 2.0 * lattice_.cell_m;
      const Part near{std::max(part.begin_m, middle_m - known_m), std::min(part.end_m, middle_m + known_m)};
      if (!doubtful.push(near) && touches(near)) return false;
    }
    for (const Part& rest : {Part{part.begin_m, middle_m - known_m}, Part{middle_m + known_m, part.end_m}})
      if (rest.begin_m < rest.end_m && !parts.push(rest) && touches(rest)) return false;
  }
  while (!doubtful.is_empty())
    if (touches(doubtful.pop())) return false;
  return true;
}

double DiscSpace::share_that_fits(const Point& from, const Point& to, double radius_m) const {
  if (!fits(from, radius_m)) return 0.0;
  double good = 0.0;
  double bad = 1.0;
  while ((bad - good) * (to - from).norm() > 0.01 * lattice_.cell_m) {
    const double middle = 0.5 * (good + bad);
    (fits_along(from, from + middle * (to - from), radius_m) ? good : bad) = middle;
  }
  return good;
}

double DiscSpace::distance_m(const Point& from, const Point& to) const {
  // No further than what the field knows at any point; the cells within that decide.
  double best_m = std::numeric_limits<double>::infinity();
  const int steps = 1 + static_cast<int>((to - from).norm() / lattice_.cell_m);
  for (int i = 0; i <= steps; ++i) {
    const Point p = from + (to - from) * (static_cast<double>(i) / steps);
    const Cell cell = field_.cell_at(p);
    best_m = std::min(best_m, field_.distance_m(cell) + (p - lattice_.centre_of(cell)).norm());
  }
  (void)any_cell_near(lattice_, from, to, best_m, [&](Cell cell) {
    if (is_blocked(cell))
      best_m = std::min(best_m, distance_to_square_m(from, to, lattice_.centre_of(cell), lattice_.cell_m));
    return false;
  });
  return best_m;
}

bool DiscSpace::joined(const Point& a, const Point& b) const {
  if (!contains(a) || !contains(b)) return false;
  const CellBox box = field_.box();
  std::call_once(parts_->made, [&] { parts_->numbers = connected_cells(field_); });
  const auto number = [&](const Point& p) {
    const Cell cell = field_.cell_at(p) - box.min;
    return parts_->numbers[static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(box.width()) +
                           static_cast<std::size_t>(cell.x)];
  };
  return number(a) != 0 && number(a) == number(b);
}

TravelField DiscSpace::travel_at_most(const Point& from, double radius_m) const {
  // A disc at any point p of a cell keeps radius_m from every blocked square, which holds a disc of half
  // a cell round its own centre; p lies within half a diagonal of the cell's centre.
  const double centres_m = radius_m + (0.5 - kHalfDiagonal) * lattice_.cell_m;
  return TravelField(field_, from, std::max(centres_m - 1e-6, 0.5 * lattice_.cell_m));
}

}  // namespace cairn
