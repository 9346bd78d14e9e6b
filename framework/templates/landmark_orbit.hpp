// Drives the simulated robot round a landmark that stands alone in free space, and maps what it senses
// (docs/method.md 6.2).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "framework/contracts/mapper.hpp"
#include "framework/contracts/module.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/world.hpp"
#include "maps/geometry/contour.hpp"

namespace cairn {

// Who drives, senses and maps.
struct OrbitCrew {
  const RobotModel& robot;
  const PluginChoice& sensor;
  const PluginChoice& map;
  const ModuleMaker& modules;
};

enum class Side { left, right };  // of the robot, where the landmark is

struct OrbitPlan {
  double orientation_rad = 0.0;           // of the landmark
  Point offset_m{0.0, 0.0};               // of its centre from that of cell (0, 0)
  std::vector<double> standoffs_m{0.55};  // from the contour's outer circle to the robot's centre
  std::vector<Side> landmark_sides{Side::left};
  double speed_mps = 0.2;
  std::uint64_t seed = 1;
  Surface surface = Surface::rough;
  // Readings whose beam stays farther than this from the landmark's centre are not mapped: cells within
  // it get the same values from a mapper that changes only the cells of a beam.
  double needed_m = 1e9;
};

// The mapper after the orbits, one at each standoff and side, both sides of the first standoff first. The robot's
// sonars end a little beyond the landmark, odometry and compass are free of error. The
// same arguments give the same map. Throws what the modules throw, and std::runtime_error when the sensor cannot be
// driven or ends before the orbit does.
[[nodiscard]] std::shared_ptr<Mapper> map_of_orbits(const OrbitCrew& crew, const Contour& contour,
                                                    const OrbitPlan& plan);

}  // namespace cairn
