// Templates: what a landmark category looks like in the gradients of OG1, one per orientation
// (docs/method.md 6; paper section 3.3).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "maps/geometry/contour.hpp"
#include "maps/grid/cell.hpp"

namespace cairn {

// One edge cell: its place relative to the template's centre cell, and the Sobel gradient there.
// Gradients are 3x3 Sobel responses of OL (0..255), each within +-1020, rounded to whole numbers.
struct TemplateCell {
  Cell offset;
  std::int16_t gradient_x = 0;
  std::int16_t gradient_y = 0;
  bool operator==(const TemplateCell&) const = default;
};

struct LandmarkTemplate {
  std::string category;
  double orientation_rad = 0.0;
  std::vector<TemplateCell> cells;  // sorted by (y, x)
  // Its mismatch is divided by this: more than 1 where drives through a room show less of the landmark than the drive
  // that the template is of, as with smooth faces.
  double tolerance = 1.0;

  // The cells that a mismatch is divided by.
  [[nodiscard]] std::size_t scored_cells() const;
};

// All templates of a mission in a fixed order: categories as given, orientations rising. An orientation
// may have several templates, one after the other: one a size.
struct TemplateSet {
  double cell_m = 0.05;
  double step_rad = 0.0;
  std::vector<LandmarkShape> shapes;  // one a category
  std::vector<LandmarkTemplate> templates;

  [[nodiscard]] double smallest_diameter_m() const;  // d_min: smallest outer diameter of the shapes
  [[nodiscard]] double largest_diameter_m() const;   // d_max
};

// How far the cells of any of them lie from their template's centre cell, at most (chessboard distance).
[[nodiscard]] int reach_of(std::span<const LandmarkTemplate> templates);

// For detectors. Give the set back, or throw std::invalid_argument with a sentence: when there is no template,
// or one without cells; when the grid's cells are not as large as those that the set was rendered for.
[[nodiscard]] std::shared_ptr<const TemplateSet> usable(std::shared_ptr<const TemplateSet> set,
                                                        const std::string& detector);
void check_cell_size(const TemplateSet& set, double grid_cell_m);

// Orientations of a shape that differ when rendered at this cell size: 0, step, 2 step, ... up to
// the first repeat (circle 1, square 6, equilateral triangle 8 at 15 degrees).
[[nodiscard]] std::vector<double> distinct_orientations(const Contour& contour, double step_rad, double cell_m);

// docs/method.md 6.1: free outside, a ring of occupied cells biased half a cell outward, unknown inside.
[[nodiscard]] LandmarkTemplate render_ideal(const LandmarkShape& shape, double orientation_rad, double cell_m);
// Sizes: as shares of a shape's own, one template each at every orientation.
[[nodiscard]] TemplateSet render_ideal_set(const std::vector<LandmarkShape>& shapes, double step_rad, double cell_m,
                                           const std::vector<double>& sizes = {1.0});

}  // namespace cairn
