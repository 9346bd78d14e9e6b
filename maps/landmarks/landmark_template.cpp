#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "maps/landmarks/ring_template.hpp"

namespace cairn {
namespace {

// The ideal rendering's bands of signed distance, in cells (docs/method.md 6.1).
constexpr double kRingInside = -1.5;
constexpr double kRingOutside = 1.0;
constexpr double kEdgeOutside = 1.5;
// Many outlines pass exactly through cell centres. Rounding must not decide on which side those
// fall, or a square turned by 90 degrees would differ from itself.
constexpr double kTie = 1e-6;

constexpr std::uint8_t kFreeOl = 0;
constexpr std::uint8_t kOccupiedOl = 255;

void require_positive(double value, const char* what) {
  if (!std::isfinite(value) || value <= 0.0) {
    throw std::invalid_argument(fmt::format("{} must be above 0, not {:f}", what, value));
  }
}

// Signed distances in cells over the square patch of cells |x|, |y| <= reach about the centre.
// Distances count from the outline moved outward by the offset.
class Patch {
 public:
  Patch(const Contour& contour, double orientation_rad, double cell_m, double ring_offset_m)
      : reach_(static_cast<int>(std::ceil((0.5 * contour.outer_diameter_m() + std::max(0.0, ring_offset_m)) / cell_m +
                                          kEdgeOutside)) +
               1),
        side_(2 * reach_ + 1) {
    const Pose2 T_shape_patch{0.0, 0.0, -orientation_rad};
    distances_.reserve(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
    for (int y = -reach_; y <= reach_; ++y) {
      for (int x = -reach_; x <= reach_; ++x) {
        const double distance_m = contour.signed_distance(T_shape_patch * Point{x * cell_m, y * cell_m});
        distances_.push_back((distance_m - ring_offset_m) / cell_m);
      }
    }
  }

  [[nodiscard]] int reach() const { return reach_; }
  [[nodiscard]] double distance(int x, int y) const {
    return distances_[static_cast<std::size_t>(y + reach_) * static_cast<std::size_t>(side_) +
                      static_cast<std::size_t>(x + reach_)];
  }
  [[nodiscard]] int ol(int x, int y) const {
    const double d = distance(x, y);
    // A tie counts as free: the other way an aligned side would have two equal rows and no slope.
    if (d >= kRingOutside - kTie) return kFreeOl;
    return d > kRingInside + kTie ? kOccupiedOl : 127;
  }
  [[nodiscard]] bool is_edge(int x, int y) const {
    const double d = distance(x, y);
    return d >= -kTie && d <= kEdgeOutside + kTie;
  }

 private:
  int reach_;
  int side_;
  std::vector<double> distances_;
};

TemplateCell sobel(const Patch& patch, int x, int y) {
  const auto ol = [&](int dx, int dy) { return patch.ol(x + dx, y + dy); };
  const int gradient_x = (ol(1, -1) + 2 * ol(1, 0) + ol(1, 1)) - (ol(-1, -1) + 2 * ol(-1, 0) + ol(-1, 1));
  const int gradient_y = (ol(-1, 1) + 2 * ol(0, 1) + ol(1, 1)) - (ol(-1, -1) + 2 * ol(0, -1) + ol(1, -1));
  return {{x, y}, static_cast<std::int16_t>(gradient_x), static_cast<std::int16_t>(gradient_y)};
}

std::vector<TemplateCell> ideal_cells(const Contour& contour, double orientation_rad, double cell_m,
                                      double ring_offset_m = 0.0) {
  const Patch patch(contour, orientation_rad, cell_m, ring_offset_m);
  std::vector<TemplateCell> cells;
  for (int y = -patch.reach() + 1; y < patch.reach(); ++y) {
    for (int x = -patch.reach() + 1; x < patch.reach(); ++x) {
      if (patch.is_edge(x, y)) cells.push_back(sobel(patch, x, y));
    }
  }
  return cells;
}

using Rendering = std::vector<TemplateCell>;

// The least p after which the whole turn repeats. One equal pair is not enough: with coarse cells
// two neighbouring orientations may look alike without the shape being symmetric.
std::size_t period_of(const std::vector<Rendering>& turn) {
  for (std::size_t period = 1; period < turn.size(); ++period) {
    bool repeats = true;
    for (std::size_t k = 0; repeats && k + period < turn.size(); ++k) repeats = turn[k] == turn[k + period];
    if (repeats && 2 * period <= turn.size()) return period;
  }
  return turn.size();
}

}  // namespace

std::size_t LandmarkTemplate::scored_cells() const {
  return static_cast<std::size_t>(std::lround(tolerance * static_cast<double>(cells.size())));
}

double TemplateSet::smallest_diameter_m() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const LandmarkShape& shape : shapes) smallest = std::min(smallest, shape.contour.outer_diameter_m());
  return smallest;
}

double TemplateSet::largest_diameter_m() const {
  double largest = 0.0;
  for (const LandmarkShape& shape : shapes) largest = std::max(largest, shape.contour.outer_diameter_m());
  return largest;
}

int reach_of(std::span<const LandmarkTemplate> templates) {
  int reach = 0;
  for (const LandmarkTemplate& t : templates) {
    for (const TemplateCell& cell : t.cells) reach = std::max(reach, distance8(cell.offset, {0, 0}));
  }
  return reach;
}

std::shared_ptr<const TemplateSet> usable(std::shared_ptr<const TemplateSet> set, const std::string& detector) {
  if (set == nullptr || set->templates.empty())
    throw std::invalid_argument(detector + " has no templates to look for; name a folder of template files");
  for (const LandmarkTemplate& t : set->templates)
    if (t.cells.empty()) throw std::invalid_argument("a template of category \"" + t.category + "\" has no cells");
  return set;
}

void check_cell_size(const TemplateSet& set, double grid_cell_m) {
  if (std::abs(grid_cell_m - set.cell_m) > 1e-9)
    throw std::invalid_argument(
        fmt::format("the grid's cells are {:f} m, the templates were rendered for {:f} m", grid_cell_m, set.cell_m));
}

std::vector<double> distinct_orientations(const Contour& contour, double step_rad, double cell_m) {
  require_positive(step_rad, "the orientation step");
  require_positive(cell_m, "the cell size");
  std::vector<Rendering> turn;
  for (int k = 0; k * step_rad < 2.0 * std::numbers::pi - kTie; ++k) {
    turn.push_back(ideal_cells(contour, k * step_rad, cell_m));
  }
  const std::size_t period = period_of(turn);
  std::vector<double> orientations;
  for (std::size_t k = 0; k < period; ++k) {
    const auto begin = turn.begin();
    const auto here = begin + static_cast<std::ptrdiff_t>(k);
    if (std::find(begin, here, *here) == here) orientations.push_back(static_cast<double>(k) * step_rad);
  }
  return orientations;
}

LandmarkTemplate render_ideal(const LandmarkShape& shape, double orientation_rad, double cell_m) {
  return render_ring(shape, orientation_rad, cell_m, 0.0);
}

LandmarkTemplate render_ring(const LandmarkShape& shape, double orientation_rad, double cell_m, double ring_offset_m) {
  require_positive(cell_m, "the cell size");
  std::vector<TemplateCell> cells = ideal_cells(shape.contour, orientation_rad, cell_m, ring_offset_m);
  if (cells.empty())
    throw std::invalid_argument(
        fmt::format("a ring drawn {:g} m outside the outline of the {} has no cell", ring_offset_m, shape.category));
  return {shape.category, orientation_rad, std::move(cells)};
}

TemplateSet render_ideal_set(const std::vector<LandmarkShape>& shapes, double step_rad, double cell_m,
                             const std::vector<double>& sizes) {
  return render_ring_set(shapes, step_rad, cell_m, sizes, 0.0);
}

TemplateSet render_ring_set(const std::vector<LandmarkShape>& shapes, double step_rad, double cell_m,
                            const std::vector<double>& sizes, double ring_offset_m) {
  TemplateSet set{cell_m, step_rad, shapes, {}};
  for (const LandmarkShape& shape : shapes) {
    for (const double orientation_rad : distinct_orientations(shape.contour, step_rad, cell_m)) {
      for (const double size : sizes)
        set.templates.push_back(
            render_ring({shape.category, shape.contour.scaled(size)}, orientation_rad, cell_m, ring_offset_m));
    }
  }
  return set;
}

}  // namespace cairn
