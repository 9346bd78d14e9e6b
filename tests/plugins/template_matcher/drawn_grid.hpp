// Grids for tests, from drawings or painted shapes.
#pragma once

#include <string>
#include <vector>

#include "maps/geometry/contour.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_template.hpp"

namespace cairn::template_matcher {

// '#' occupied, '.' free, anything else unknown. The last row is y = 0.
inline OccupancyGrid grid_of(const std::vector<std::string>& rows, double cell_m = 0.05) {
  OccupancyGrid grid(cell_m);
  const int height = static_cast<int>(rows.size());
  for (int y = 0; y < height; ++y) {
    const std::string& row = rows[static_cast<std::size_t>(height - 1 - y)];
    for (int x = 0; x < static_cast<int>(row.size()); ++x) {
      const char mark = row[static_cast<std::size_t>(x)];
      grid.set_log_odds({x, y}, static_cast<LogOdds>(mark == '#' ? 1024 : mark == '.' ? -1024 : 0));
    }
  }
  return grid;
}

// Paints what a perfect tour round the contour leaves: free outside, a ring, nothing known inside.
inline void paint(OccupancyGrid& grid, const Contour& contour, const Pose2& T_map_shape, const CellBox& box) {
  const Pose2 T_shape_map = inverse(T_map_shape);
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const double cells = contour.signed_distance(T_shape_map * grid.centre_of({x, y})) / grid.cell_m();
      const int log_odds = cells > 1.0 ? -1024 : cells > -1.5 ? 1024 : 0;
      grid.set_log_odds({x, y}, static_cast<LogOdds>(log_odds));
    }
  }
}

inline LandmarkShape circle_shape() {
  return {"circle", Contour::circle(0.5)};
}
inline LandmarkShape square_shape() {
  return {"square", Contour::polygon({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}})};
}
inline LandmarkShape triangle_shape() {
  return {"triangle", Contour::polygon({{0, 0}, {0.6, 0}, {0.3, 0.5196152}})};
}

inline TemplateSet paper_set(double cell_m = 0.05) {
  return render_ideal_set({circle_shape(), square_shape(), triangle_shape()}, radians(15.0), cell_m);
}

}  // namespace cairn::template_matcher
