#include "framework/host/sensed_templates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cairn {
namespace {

struct Gradient {
  double x = 0.0;
  double y = 0.0;
};

// What every lap needs.
struct Studio {
  double cell_m;
  const SensedOptions& options;
  const RobotModel& robot;
  const PluginChoice& sensor;
  const PluginChoice& map;
  const ModuleMaker& modules;
};

// The landmark alone in free space.
World world_of(const LandmarkShape& shape, const Pose2& T_map_landmark, double extent_m) {
  World world;
  world.min_m = T_map_landmark.position() - Point{extent_m, extent_m};
  world.max_m = T_map_landmark.position() + Point{extent_m, extent_m};
  world.objects.push_back({shape.category, shape.contour, T_map_landmark, Surface::rough});
  return world;
}

// A calibrated copy whose sonars end a little beyond the landmark: what lies further away costs time
// and tells nothing.
RobotModel calibrated(const RobotModel& robot, double far_enough_m) {
  RobotModel exact = robot;
  exact.odometry_error = {};
  exact.compass_error = {};
  for (SonarModel& sonar : exact.sonars) sonar.max_m = std::max(sonar.min_m, std::min(sonar.max_m, far_enough_m));
  return exact;
}

// Drives one lap and hands every observation to the mapper.
void drive_lap(Sensor& sensor, Mapper& mapper, const Pose2& T_map_start, const Twist& twist) {
  Drive* drive = sensor.drive();
  if (drive == nullptr) throw std::runtime_error("sensed templates need a sensor that can be driven");
  drive->command(twist);
  const Budget budget;
  double turned_rad = 0.0;
  double heading_rad = T_map_start.theta_rad;
  // Starting and the first turn of the wheels take a little longer than the lap itself.
  const int most_steps = static_cast<int>(1.0e6);
  for (int step = 0; step < most_steps && std::abs(turned_rad) < 2.0 * std::numbers::pi; ++step) {
    const SensorStep next = sensor.next(budget);
    if (next.state != SensorState::observation) {
      throw std::runtime_error("sensed templates: the sensor stopped during a lap: " + next.reason);
    }
    PoseEstimate pose;
    pose.T_map_robot = T_map_start * next.observation.T_odom_robot;
    (void)mapper.integrate(next.observation, pose);
    turned_rad += wrap_angle(pose.T_map_robot.theta_rad - heading_rad);
    heading_rad = pose.T_map_robot.theta_rad;
    if (next.observation.bumped) throw std::runtime_error("sensed templates: the robot touched the landmark");
  }
}

Gradient sobel(const OccupancyGrid& grid, Cell c) {
  const auto ol = [&](int x, int y) { return static_cast<double>(grid.ol(c + Cell{x, y})); };
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

ModuleContext context_of(const Studio& studio, const RobotModel& robot, std::uint64_t seed, const Pose2& T_map_start,
                         const World* world) {
  ModuleContext context{robot};
  context.world = world;
  context.T_map_start = T_map_start;
  context.seed = seed;
  context.modules = &studio.modules;
  return context;
}

enum class Side { left, right };  // of the robot, where the landmark is

// Maps one lap and adds its gradients. The landmark's centre is the centre of cell (0, 0).
void add_lap(const Studio& studio, const LandmarkShape& shape, double orientation_rad, Side landmark_side, int lap,
             const std::vector<TemplateCell>& cells, std::vector<Gradient>& sums) {
  const double radius_m = 0.5 * shape.contour.outer_diameter_m() + studio.options.standoff_m;
  const RobotModel robot = calibrated(studio.robot, 2.0 * radius_m);
  const std::uint64_t seed = studio.options.seed + static_cast<std::uint64_t>(lap);
  const auto mapper = studio.modules.make<Mapper>(studio.map, context_of(studio, robot, seed, {}, nullptr));
  if (std::abs(mapper->grid().cell_m() - studio.cell_m) > 1e-9) {
    throw std::invalid_argument("sensed templates for cells of " + std::to_string(studio.cell_m) +
                                " m need a mapper with such cells, not " + std::to_string(mapper->grid().cell_m()));
  }
  const Point centre = mapper->grid().centre_of({0, 0});
  const World world = world_of(shape, {centre.x(), centre.y(), orientation_rad}, 2.0 * radius_m + 1.0);
  const double side = landmark_side == Side::left ? 1.0 : -1.0;
  const Pose2 T_map_start{centre.x() + side * radius_m, centre.y(), std::numbers::pi / 2.0};
  const auto sensor = studio.modules.make<Sensor>(studio.sensor, context_of(studio, robot, seed, T_map_start, &world));
  const double speed_mps = std::min(studio.options.speed_mps, robot.max_v_mps);
  drive_lap(*sensor, *mapper, T_map_start, {speed_mps, side * speed_mps / radius_m});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Gradient gradient = sobel(mapper->grid(), cells[i].offset);
    sums[i].x += gradient.x;
    sums[i].y += gradient.y;
  }
}

LandmarkTemplate render_sensed(const Studio& studio, const LandmarkShape& shape, double orientation_rad,
                               Side landmark_side) {
  std::vector<TemplateCell> cells = band_of(shape.contour, orientation_rad, studio.cell_m, studio.options);
  std::vector<Gradient> sums(cells.size());
  for (int lap = 0; lap < studio.options.laps; ++lap) {
    add_lap(studio, shape, orientation_rad, landmark_side, lap, cells, sums);
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i].gradient_x = static_cast<std::int16_t>(std::lround(sums[i].x / studio.options.laps));
    cells[i].gradient_y = static_cast<std::int16_t>(std::lround(sums[i].y / studio.options.laps));
  }
  std::erase_if(cells, [&](const TemplateCell& cell) {
    return std::hypot(cell.gradient_x, cell.gradient_y) < studio.options.least_gradient;
  });
  if (cells.empty())
    throw std::runtime_error("sensed templates: a lap round the " + shape.category +
                             " left no edge in the map that is steep enough to be recognised");
  return {shape.category, orientation_rad, std::move(cells)};
}

}  // namespace

TemplateSet render_sensed_set(const std::vector<LandmarkShape>& shapes, double step_rad, double cell_m,
                              const SensedOptions& options, const RobotModel& robot, const PluginChoice& sensor,
                              const PluginChoice& map, const ModuleMaker& modules) {
  if (options.laps < 1) throw std::invalid_argument("sensed templates need a lap, not " + std::to_string(options.laps));
  const Studio studio{cell_m, options, robot, sensor, map, modules};
  TemplateSet set{cell_m, step_rad, shapes, {}};
  for (const LandmarkShape& shape : shapes) {
    for (const double orientation_rad : distinct_orientations(shape.contour, step_rad, cell_m)) {
      for (const Side side : {Side::left, Side::right}) {
        set.templates.push_back(render_sensed(studio, shape, orientation_rad, side));
      }
    }
  }
  return set;
}

}  // namespace cairn
