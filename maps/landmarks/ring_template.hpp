// Drawn templates whose ring lies beside the outline, where the maps of a sensor show it (docs/method.md 6.1).
#pragma once

#include <vector>

#include "maps/landmarks/landmark_template.hpp"

namespace cairn {

// As render_ideal() and render_ideal_set(), with the ring drawn so far outside the outline (negative: inside). Throw
// std::invalid_argument when a ring has no cell.
[[nodiscard]] LandmarkTemplate render_ring(const LandmarkShape& shape, double orientation_rad, double cell_m,
                                           double ring_offset_m);
[[nodiscard]] TemplateSet render_ring_set(const std::vector<LandmarkShape>& shapes, double step_rad, double cell_m,
                                          const std::vector<double>& sizes, double ring_offset_m);

}  // namespace cairn
