// Templates as the mission's own sensors and mapper would see the landmarks (docs/method.md 6.2).
#pragma once

#include <cstdint>
#include <vector>

#include "framework/contracts/module.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/templates/template_cache.hpp"
#include "maps/landmarks/landmark_template.hpp"

namespace cairn {

struct SensedOptions {
  std::vector<double> sizes{1.0};        // as shares of a shape's own; a template each
  bool smooth_too = false;               // a second template each, of the landmark with a smooth surface
  double smooth_tolerance = 1.2;         // of these (LandmarkTemplate::tolerance)
  std::vector<double> gaps_m{0.2, 0.6};  // from the contour's outer circle to the robot's; an orbit each way at each
  double speed_mps = 0.3;
  double edge_inside_cells = 2.0;   // the template's cells: this far inside the contour
  double edge_outside_cells = 3.0;  // and this far outside
  // Cells with a weaker gradient (Sobel of OL) are left out: unseen floor matches those best of all, so
  // they lift the degree of places where nothing stands (0.61 with them, 0.50 without, at equal hits).
  double min_gradient = 450.0;
  std::uint64_t seed = 1;
};

// Lets the simulated robot drive round each contour, at each distinct orientation, in free space; the
// templates are the Sobel gradients of the maps that arise. It drives each way: sonars beside the middle turn
// an outline in the direction of travel, so that the maps of two orbits differ by 12 degrees or so, and a template
// of one of them misses the orientation of a landmark seen both ways by half of that. It drives near and
// farther off: the farther orbit rounds what the near one sharpens, as a drive through a room does both, and a
// round landmark is distinguished from an angular one by little else. The landmark stands with its centre on the centre
// of a cell, the surface is rough (and smooth, another time, where that is asked for and the robot has no laser, which
// nothing mirrors), odometry and compass are free of error. The same arguments give the same templates, with the cache
// or without. Throws what the modules throw, and std::runtime_error when the sensor cannot be driven or ends before the
// orbit does.
[[nodiscard]] TemplateSet render_sensed_set(const std::vector<LandmarkShape>& shapes, double step_rad, double cell_m,
                                            const SensedOptions& options, const RobotModel& robot,
                                            const PluginChoice& sensor, const PluginChoice& map,
                                            const ModuleLibrary& modules, const TemplateCache& cache = TemplateCache());

}  // namespace cairn
