#include "framework/templates/landmark_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cairn {
namespace {

// The landmark alone in free space.
World world_of(const Contour& contour, const Pose2& T_map_landmark, Surface surface, double extent_m) {
  World world;
  world.min_m = T_map_landmark.position() - Point{extent_m, extent_m};
  world.max_m = T_map_landmark.position() + Point{extent_m, extent_m};
  world.objects.push_back({"", contour, T_map_landmark, surface});
  return world;
}

// A calibrated copy whose sonars and lasers end a little beyond the landmark: what lies further away costs time
// and says nothing.
RobotModel calibrated(const RobotModel& robot, double far_enough_m) {
  RobotModel exact = robot;
  exact.odometry_error = {};
  exact.compass_error = {};
  for (SonarModel& sonar : exact.sonars) sonar.max_m = std::max(sonar.min_m, std::min(sonar.max_m, far_enough_m));
  for (LaserModel& laser : exact.lasers) laser.max_m = std::max(laser.min_m, std::min(laser.max_m, far_enough_m));
  return exact;
}

// Whether the beam's cone, of whatever length, comes within this distance of a point.
bool comes_near(const RangeReading& reading, const Pose2& T_map_robot, const Point& p, double within_m) {
  constexpr double kSpare_rad = radians(2.0);
  const Pose2 T_map_sensor = T_map_robot * reading.T_robot_sensor;
  const Point offset = p - T_map_sensor.position();
  const double distance_m = offset.norm();
  if (distance_m <= within_m) return true;
  const double off_axis_rad = std::abs(wrap_angle(std::atan2(offset.y(), offset.x()) - T_map_sensor.theta_rad));
  return off_axis_rad <= reading.half_beam_rad + std::asin(within_m / distance_m) + kSpare_rad;
}

constexpr double kCommandValid_s = 1.0;

// Drives one orbit and hands every observation to the mapper.
void drive_orbit(Sensor& sensor, Mapper& mapper, const Pose2& T_map_start, const Twist& twist, const Point& centre_m,
                 double needed_m) {
  Drive* drive = sensor.drive();
  if (drive == nullptr) throw std::runtime_error("sensed templates need a sensor that can be driven");
  const Budget budget;
  double turned_rad = 0.0;
  double heading_rad = T_map_start.theta_rad;
  // Starting and the first turn of the wheels take a little longer than the orbit itself.
  const int max_steps = static_cast<int>(1.0e6);
  for (int step = 0; step < max_steps && std::abs(turned_rad) < 2.0 * std::numbers::pi; ++step) {
    drive->command(twist, kCommandValid_s);
    SensorStep next = sensor.next(budget);
    if (next.state != SensorState::observation) {
      throw std::runtime_error("sensed templates: the sensor stopped during an orbit: " + next.reason);
    }
    PoseEstimate pose;
    pose.T_map_robot = T_map_start * next.observation.T_odom_robot;
    std::erase_if(next.observation.ranges, [&](const RangeReading& reading) {
      return !comes_near(reading, pose.T_map_robot, centre_m, needed_m);
    });
    (void)mapper.integrate(next.observation, pose);
    turned_rad += wrap_angle(pose.T_map_robot.theta_rad - heading_rad);
    heading_rad = pose.T_map_robot.theta_rad;
    if (next.observation.bumped) throw std::runtime_error("sensed templates: the robot touched the landmark");
  }
}

}  // namespace

std::shared_ptr<Mapper> map_of_orbits(const OrbitCrew& crew, const Contour& contour, const OrbitPlan& plan) {
  const double contour_m = 0.5 * contour.outer_diameter_m();
  const double farthest_m = contour_m + std::ranges::max(plan.standoffs_m);
  const RobotModel robot = calibrated(crew.robot, 2.0 * farthest_m);
  const ModuleContext context{robot, plan.seed, &crew.modules};
  auto mapper = crew.modules.make<Mapper>(crew.map, {context});
  const Point centre = mapper->grid().centre_of({0, 0}) + plan.offset_m;
  const World world =
      world_of(contour, {centre.x(), centre.y(), plan.orientation_rad}, plan.surface, 2.0 * farthest_m + 1.0);
  const double speed_mps = std::min(plan.speed_mps, robot.max_v_mps);
  for (const double standoff_m : plan.standoffs_m) {
    for (const Side landmark_side : plan.landmark_sides) {
      const double radius_m = contour_m + standoff_m;
      const double side = landmark_side == Side::left ? 1.0 : -1.0;
      const Pose2 T_map_start{centre.x() + side * radius_m, centre.y(), std::numbers::pi / 2.0};
      const auto sensor = crew.modules.make<Sensor>(crew.sensor, {context, &world, T_map_start});
      drive_orbit(*sensor, *mapper, T_map_start, {speed_mps, side * speed_mps / radius_m}, centre, plan.needed_m);
    }
  }
  return mapper;
}

}  // namespace cairn
