#include "framework/templates/sensed_templates.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "framework/modules/module_library.hpp"
#include "framework/templates/landmark_orbit.hpp"
#include "maps/base/in_parallel.hpp"

namespace cairn {
namespace {

struct Gradient {
  int x = 0;
  int y = 0;
};

struct Studio {
  double cell_m;
  const SensedOptions& options;
  OrbitCrew crew;
};

Gradient sobel(const OccupancyGrid& grid, Cell c) {
  const auto ol = [&](int x, int y) { return static_cast<int>(grid.ol(c + Cell{x, y})); };
  return {(ol(1, -1) + 2 * ol(1, 0) + ol(1, 1)) - (ol(-1, -1) + 2 * ol(-1, 0) + ol(-1, 1)),
          (ol(-1, 1) + 2 * ol(0, 1) + ol(1, 1)) - (ol(-1, -1) + 2 * ol(0, -1) + ol(1, -1))};
}

// The cells of the template, without gradients.
std::vector<TemplateCell> band_of(const Contour& contour, double orientation_rad, double cell_m,
                                  const SensedOptions& options) {
  constexpr double kTie = 1e-6;  // outlines often pass through cell centres; rounding must not decide
  const Pose2 T_shape_grid{0.0, 0.0, -orientation_rad};
  const int reach =
      static_cast<int>(std::ceil(0.5 * contour.outer_diameter_m() / cell_m + options.edge_outside_cells)) + 1;
  std::vector<TemplateCell> cells;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const double distance = contour.signed_distance(T_shape_grid * Point{x * cell_m, y * cell_m}) / cell_m;
      if (distance < -options.edge_inside_cells - kTie || distance > options.edge_outside_cells + kTie) continue;
      cells.push_back({{x, y}, 0, 0});
    }
  }
  return cells;
}

// Maps the orbits. The landmark's centre is the centre of cell (0, 0).
LandmarkTemplate render_sensed(const Studio& studio, const LandmarkShape& shape, double orientation_rad,
                               Surface surface) {
  const SensedOptions& options = studio.options;
  std::vector<TemplateCell> cells = band_of(shape.contour, orientation_rad, studio.cell_m, options);
  OrbitPlan plan;
  plan.orientation_rad = orientation_rad;
  plan.standoffs_m.clear();
  for (const double gap_m : options.gaps_m) plan.standoffs_m.push_back(studio.crew.robot.radius_m + gap_m);
  plan.landmark_sides = {Side::left, Side::right};
  plan.speed_mps = options.speed_mps;
  plan.seed = options.seed;
  plan.surface = surface;
  // The template's cells, those that Sobel looks at beside them, and the spread of a cell.
  plan.needed_m = 0.5 * shape.contour.outer_diameter_m() + (options.edge_outside_cells + 3.0) * studio.cell_m;
  const auto mapper = map_of_orbits(studio.crew, shape.contour, plan);
  if (std::abs(mapper->grid().cell_m() - studio.cell_m) > 1e-9) {
    throw std::invalid_argument("sensed templates for cells of " + std::to_string(studio.cell_m) +
                                " m need a mapper with such cells, not " + std::to_string(mapper->grid().cell_m()));
  }
  for (TemplateCell& cell : cells) {
    const Gradient gradient = sobel(mapper->grid(), cell.offset);
    cell.gradient_x = static_cast<std::int16_t>(gradient.x);
    cell.gradient_y = static_cast<std::int16_t>(gradient.y);
  }
  std::erase_if(cells, [&](const TemplateCell& cell) {
    return std::hypot(cell.gradient_x, cell.gradient_y) < options.min_gradient;
  });
  if (cells.empty())
    throw std::runtime_error("sensed templates: an orbit round the " + shape.category +
                             " left no edge in the map that is steep enough to be recognised");
  return {shape.category, orientation_rad, std::move(cells),
          surface == Surface::smooth ? options.smooth_tolerance : 1.0};
}

struct RenderTask {
  const LandmarkShape* shape;
  double orientation_rad;
  double size;
  Surface surface;
};

std::vector<LandmarkTemplate> render_all(const Studio& studio, const std::vector<RenderTask>& tasks) {
  std::vector<LandmarkTemplate> templates(tasks.size());
  in_parallel(tasks.size(), [&](std::size_t i) {
    const auto& [shape, orientation_rad, size, surface] = tasks[i];
    templates[i] = render_sensed(studio, {shape->category, shape->contour.scaled(size)}, orientation_rad, surface);
  });
  return templates;
}

std::vector<RenderTask> render_tasks_for(const LandmarkShape& shape, double step_rad, double cell_m,
                                         const SensedOptions& options, const RobotModel& robot) {
  const bool smooth_too = options.smooth_too && !shape.contour.is_circle() && robot.lasers.empty();
  std::vector<RenderTask> tasks;
  for (const double orientation_rad : distinct_orientations(shape.contour, step_rad, cell_m))
    for (const double size : options.sizes) {
      tasks.push_back({&shape, orientation_rad, size, Surface::rough});
      if (smooth_too) tasks.push_back({&shape, orientation_rad, size, Surface::smooth});
    }
  return tasks;
}

// The robot that draws templates is in order and as its file says, whatever the mission's is to suffer.
PluginChoice without_faults(PluginChoice sensor) {
  std::erase_if(sensor.config.entries, [](const ConfigValue::Entry& entry) {
    return entry.key == "faults" || entry.key == "random_faults" || entry.key == "battery" || entry.key == "truth";
  });
  return sensor;
}

}  // namespace

TemplateSet render_sensed_set(const std::vector<LandmarkShape>& shapes, double step_rad, double cell_m,
                              const SensedOptions& options, const RobotModel& robot, const PluginChoice& missions_own,
                              const PluginChoice& map, const ModuleLibrary& modules, const TemplateCache& cache) {
  const PluginChoice sensor = without_faults(missions_own);
  const Studio studio{cell_m, options, {robot, sensor, map, modules}};
  const std::string common_key = rendering_key(step_rad, cell_m, options, robot, sensor, map, modules);
  std::vector<std::optional<std::vector<LandmarkTemplate>>> kept;
  std::vector<RenderTask> tasks;
  for (const LandmarkShape& shape : shapes) {
    kept.push_back(cache.find(shape_key(common_key, shape)));
    if (kept.back()) continue;
    const std::vector<RenderTask> more = render_tasks_for(shape, step_rad, cell_m, options, robot);
    tasks.insert(tasks.end(), more.begin(), more.end());
  }
  std::vector<LandmarkTemplate> rendered = render_all(studio, tasks);
  TemplateSet set{cell_m, step_rad, shapes, {}};
  for (std::size_t shape = 0, task = 0; shape < shapes.size(); ++shape) {
    std::vector<LandmarkTemplate> own = std::move(kept[shape]).value_or(std::vector<LandmarkTemplate>());
    const bool is_fresh = own.empty();
    for (; task < tasks.size() && tasks[task].shape == &shapes[shape]; ++task) own.push_back(std::move(rendered[task]));
    if (is_fresh) cache.keep(shape_key(common_key, shapes[shape]), own);
    std::ranges::move(own, std::back_inserter(set.templates));
  }
  return set;
}

}  // namespace cairn
