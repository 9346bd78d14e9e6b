#include "plugins/odometry_compass/landmark_sightings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maps/geometry/segments.hpp"
#include "plugins/odometry_compass/outline_echo.hpp"

namespace cairn::odometry_compass {
namespace {

constexpr std::size_t kReadingsTogether = 15;  // readings that are looked at together
constexpr std::size_t kMaxRays = 60;           // of a scan, evenly spread: neighbours say the same
constexpr double kKept_s = 4.0;
constexpr double kKept_m = 1.0;
constexpr std::size_t kMinReadings = 8;  // of one landmark
constexpr double kReach_m = 4.0;         // further away sonars hear landmarks seldom
constexpr double kOutlineGate_m = 0.35;  // a reading further off than this is of something else
constexpr double kInFront_m = 0.2;       // what stands so much nearer hides the rest
constexpr double kApart_m = 0.3;         // two landmarks nearer to each other in range compete

bool is_hidden(const OccupancyGrid& grid, const Pose2& T_map_sensor, double range_m) {
  const double step_m = 0.5 * grid.cell_m();
  for (double at_m = step_m; at_m < range_m - kInFront_m; at_m += step_m)
    if (grid.state(grid.cell_at(T_map_sensor * Point(at_m, 0.0))) == CellState::occupied) return true;
  return false;
}

Eigen::Vector3d per_shift_of(const Point& per_position_map, double per_heading_m, const Pose2& T_map_robot,
                             const Point& sensor_map) {
  const double c = std::cos(T_map_robot.theta_rad);
  const double s = std::sin(T_map_robot.theta_rad);
  const Point arm = sensor_map - T_map_robot.position();
  return {c * per_position_map.x() + s * per_position_map.y(), -s * per_position_map.x() + c * per_position_map.y(),
          per_position_map.dot(Point(-arm.y(), arm.x())) + per_heading_m};
}

}  // namespace

struct LandmarkSightings::Scene {
  Pose2 T_map_robot;  // as predicted
  Pose2 T_odom_robot;
  double stamp_s;
  double gate_m;

  [[nodiscard]] Pose2 sensor_at(const FreshReading& reading, const Pose2& T_map_now) const {
    return T_map_now * (inverse(T_odom_robot) * reading.T_odom_sensor);
  }
};

std::span<const LandmarkSighting> LandmarkSightings::look(const Observation& observation, const PoseEstimate& pose,
                                                          const Pose2& T_odom_before, const KnownMap& known) {
  reported_.clear();
  anchor_landmarks(known.landmarks, pose);
  take(observation);
  if (window_.size() < kReadingsTogether) return {};
  const double spread_m = std::sqrt(std::max(0.0, pose.covariance(0, 0) + pose.covariance(1, 1)));
  const Scene scene{pose.T_map_robot * (inverse(T_odom_before) * observation.T_odom_robot), observation.T_odom_robot,
                    observation.stamp_s, std::min(kOutlineGate_m + spread_m, 2.0 * kOutlineGate_m)};
  for (const FreshReading& reading : window_) assign(reading, scene, known.grid);
  window_.clear();
  for (auto& [id, anchor] : anchors_) find(id, anchor, scene);
  return reported_;
}

void LandmarkSightings::take(const Observation& observation) {
  const Pose2& T_odom_robot = observation.T_odom_robot;
  if (!is_finite(T_odom_robot)) return;
  if (begun_) driven_m_ += (T_odom_robot.position() - T_odom_last_.position()).norm();
  begun_ = true;
  T_odom_last_ = T_odom_robot;
  if (anchors_.empty()) return;
  const auto is_ray = [](const RangeReading& range) { return range.half_beam_rad <= 0.0; };
  const auto rays = static_cast<std::size_t>(std::ranges::count_if(observation.ranges, is_ray));
  const std::size_t every = (rays + kMaxRays - 1) / kMaxRays;
  std::size_t ray = 0;
  for (const RangeReading& range : observation.ranges) {
    if (is_ray(range) && ray++ % every != 0) continue;
    const bool is_echo = std::isfinite(range.range_m) && range.range_m >= range.min_m && range.range_m <= range.max_m;
    if (!is_echo || range.range_m > kReach_m) continue;
    window_.push_back(
        {T_odom_robot * range.T_robot_sensor, range.half_beam_rad, range.range_m, observation.stamp_s, driven_m_});
  }
}

// A landmark's place is refined by later matchings in a map that has gone on with the robot's drift: it is followed
// only as long as the robot knows better where it is than when it was found.
void LandmarkSightings::anchor_landmarks(const LandmarkGraph& graph, const PoseEstimate& pose) {
  std::erase_if(anchors_, [&](const auto& entry) { return graph.find(entry.first) == nullptr; });
  const double variance_m2 = 0.5 * (pose.covariance(0, 0) + pose.covariance(1, 1));
  for (const auto& [id, landmark] : graph.landmarks()) {
    Anchor& anchor = anchors_[id];
    const bool is_same = anchor.category == landmark.category && anchor.T_map_landmark == landmark.T_map_landmark;
    if (is_same || (anchor.category == landmark.category && variance_m2 >= anchor.variance_m2)) continue;
    anchor = {landmark.T_map_landmark, landmark.category, variance_m2, nullptr, {}};
    const auto shape = std::ranges::find(shapes_, landmark.category, &LandmarkShape::category);
    if (shape != shapes_.end() && !landmark.marker) anchor.contour = &shape->contour;
  }
}

// Noise of a sonar, the map's cells, and the odometry since.
double LandmarkSightings::deviation_of(const FreshReading& reading) const {
  return std::hypot(0.03 + 0.01 * reading.range_m, 0.03 * (driven_m_ - reading.driven_m));
}

void LandmarkSightings::assign(const FreshReading& reading, const Scene& scene, const OccupancyGrid& grid) {
  const Pose2 T_map_sensor = scene.sensor_at(reading, scene.T_map_robot);
  Anchor* nearest = nullptr;
  double nearest_m = std::numeric_limits<double>::infinity();
  double next_m = nearest_m;
  for (auto& [id, anchor] : anchors_) {
    if (anchor.contour == nullptr) continue;
    const auto echo =
        expected_echo(*anchor.contour, inverse(anchor.T_map_landmark) * T_map_sensor, reading.half_beam_rad);
    if (!echo || echo->range_m >= next_m) continue;
    next_m = std::max(echo->range_m, nearest_m);
    if (echo->range_m >= nearest_m) continue;
    nearest_m = echo->range_m;
    nearest = &anchor;
  }
  const bool is_of_it = nearest != nullptr && std::abs(reading.range_m - nearest_m) <= scene.gate_m &&
                        next_m >= nearest_m + kApart_m && !is_hidden(grid, T_map_sensor, nearest_m);
  if (is_of_it) nearest->readings.push_back(reading);
}

void LandmarkSightings::find(LandmarkId id, Anchor& anchor, const Scene& scene) {
  std::erase_if(anchor.readings, [&](const FreshReading& r) {
    return r.stamp_s < scene.stamp_s - kKept_s || r.driven_m < driven_m_ - kKept_m;
  });
  if (anchor.readings.size() < kMinReadings) return;
  const auto compare = [&](int i, const Pose2& T_map_robot) -> std::optional<RangeResidual> {
    const FreshReading& reading = anchor.readings[static_cast<std::size_t>(i)];
    const Pose2 T_map_sensor = scene.sensor_at(reading, T_map_robot);
    const auto echo =
        expected_echo(*anchor.contour, inverse(anchor.T_map_landmark) * T_map_sensor, reading.half_beam_rad);
    if (!echo) return std::nullopt;
    const double c = std::cos(anchor.T_map_landmark.theta_rad);
    const double s = std::sin(anchor.T_map_landmark.theta_rad);
    const Point in_map(c * echo->per_position.x() - s * echo->per_position.y(),
                       s * echo->per_position.x() + c * echo->per_position.y());
    return RangeResidual{reading.range_m - echo->range_m,
                         per_shift_of(in_map, echo->per_heading_m, T_map_robot, T_map_sensor.position()),
                         deviation_of(reading)};
  };
  if (const auto found = align(scene.T_map_robot, static_cast<int>(anchor.readings.size()), compare))
    report(id, anchor, scene, *found);
  anchor.readings.clear();
}

void LandmarkSightings::report(LandmarkId id, const Anchor& anchor, const Scene& scene, const Alignment& found) {
  LandmarkSighting seen;
  seen.landmark = id;
  seen.T_map_landmark = anchor.T_map_landmark;
  seen.T_robot_landmark = inverse(scene.T_map_robot * found.T_from_to) * anchor.T_map_landmark;
  // A robot that is moved sees the landmark move the other way.
  Eigen::Matrix3d turned = -Eigen::Matrix3d::Identity();
  turned(0, 2) = seen.T_robot_landmark.y_m;
  turned(1, 2) = -seen.T_robot_landmark.x_m;
  seen.covariance = turned * found.covariance * turned.transpose();
  seen.covariance(0, 0) += anchor.variance_m2;
  seen.covariance(1, 1) += anchor.variance_m2;
  seen.covariance = (0.5 * (seen.covariance + seen.covariance.transpose())).eval();
  reported_.push_back(seen);
}

}  // namespace cairn::odometry_compass
