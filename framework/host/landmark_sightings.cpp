#include "framework/host/landmark_sightings.hpp"

#include <algorithm>
#include <cmath>

#include "framework/host/outline_echo.hpp"

namespace cairn {
namespace {

constexpr std::size_t kWindow_readings = 15;
constexpr double kWindow_m = 0.25;
constexpr double kWindow_s = 1.5;
constexpr double kLandmarkWindow_s = 4.0;
constexpr std::size_t kLandmarkReadings = 8;
constexpr double kMostReach_m = 6.0;
constexpr double kGate_m = 0.35;       // a reading further off than this is of something else
constexpr double kInFront_m = 0.2;     // what stands so much nearer hides the rest
constexpr double kApart_m = 0.3;       // two landmarks nearer to each other in range compete
constexpr double kOwnCells_m = 0.2;    // cells this near to an outline are the landmark's
constexpr double kFollowEvery_s = 1.0;
constexpr double kRimRatio = 0.8;
constexpr double kWideRatio = 1.5;     // of the half-beam: side lobes hear what is near

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
  double gate_m;

  [[nodiscard]] Pose2 sensor_at(const FreshReading& reading, const Pose2& T_map_now) const {
    return T_map_now * (inverse(T_odom_robot) * reading.T_odom_sensor);
  }
};

void CorrectPoseConfig::describe(Fields<CorrectPoseConfig>& fields) {
  using C = CorrectPoseConfig;
  fields.flag("by_landmarks", &C::by_landmarks, "by landmarks that are seen again");
  fields.flag("by_map", &C::by_map, "by the walls that sonars see again");
}

LandmarkSightings::LandmarkSightings(const CorrectPoseConfig& config, std::vector<LandmarkShape> shapes)
    : config_(config), shapes_(std::move(shapes)) {}

void LandmarkSightings::go_on_from(const OccupancyGrid& grid) {
  if (config_.by_map) anchor_map_.take_all(grid);
}

std::span<const LandmarkSighting> LandmarkSightings::look(const Observation& observation, const PoseEstimate& pose,
                                                          const Pose2& T_odom_last, const LandmarkGraph& graph,
                                                          const OccupancyGrid& grid, double time_s) {
  told_.clear();
  if (!config_.by_landmarks && !config_.by_map) return {};
  if (config_.by_map && time_s >= last_follow_s_ + kFollowEvery_s) {
    last_follow_s_ = time_s;
    anchor_map_.follow(grid, pose.T_map_robot.position(), kMostReach_m, time_s);
  }
  take(observation);
  const bool due = window_.size() >= kWindow_readings || driven_m_ - window_begin_m_ > kWindow_m ||
                   observation.stamp_s - window_begin_s_ > kWindow_s;
  if (window_.empty() || !due) return {};
  anchor_landmarks(graph, pose);
  const double spread_m = std::sqrt(std::max(0.0, pose.covariance(0, 0) + pose.covariance(1, 1)));
  const Scene scene{pose.T_map_robot * (inverse(T_odom_last) * observation.T_odom_robot), observation.T_odom_robot,
                    std::min(kGate_m + spread_m, 2.0 * kGate_m)};
  std::vector<FreshReading> walls;
  for (const FreshReading& reading : window_) assign(reading, scene, walls);
  window_.clear();
  window_begin_m_ = driven_m_;
  window_begin_s_ = observation.stamp_s;
  for (auto& [id, anchor] : anchors_) find_by_landmark(id, anchor, scene);
  if (config_.by_map) find_by_walls(walls, scene);
  return told_;
}

void LandmarkSightings::take(const Observation& observation) {
  const Pose2& T_odom_robot = observation.T_odom_robot;
  if (!std::isfinite(T_odom_robot.x_m) || !std::isfinite(T_odom_robot.y_m) || !std::isfinite(T_odom_robot.theta_rad))
    return;
  if (begun_) driven_m_ += (T_odom_robot.position() - T_odom_before_.position()).norm();
  begun_ = true;
  T_odom_before_ = T_odom_robot;
  for (const RangeReading& range : observation.ranges) {
    if (!std::isfinite(range.range_m) || range.range_m < range.min_m || range.range_m > range.max_m) continue;
    if (range.range_m > kMostReach_m) continue;
    window_.push_back({T_odom_robot * range.T_robot_sensor, range.half_beam_rad, range.range_m, observation.stamp_s,
                       driven_m_});
  }
}

// A landmark's place is refined by later matchings in a map that has gone on with the robot's drift: it is followed
// only as long as the robot knows better where it is than when it was found.
void LandmarkSightings::anchor_landmarks(const LandmarkGraph& graph, const PoseEstimate& pose) {
  if (!config_.by_landmarks) return;
  std::erase_if(anchors_, [&](const auto& entry) { return graph.find(entry.first) == nullptr; });
  const double variance_m2 = 0.5 * (pose.covariance(0, 0) + pose.covariance(1, 1));
  for (const auto& [id, landmark] : graph.landmarks()) {
    Anchor& anchor = anchors_[id];
    const bool is_same = anchor.category == landmark.category && anchor.T_map_landmark == landmark.T_map_landmark;
    if (is_same || (anchor.category == landmark.category && variance_m2 >= anchor.variance_m2)) continue;
    anchor = {landmark.T_map_landmark, landmark.category, variance_m2, nullptr, {}};
    const auto shape = std::ranges::find(shapes_, landmark.category, &LandmarkShape::category);
    if (shape != shapes_.end()) anchor.contour = &shape->contour;
  }
}

// Noise of a sonar, the map's cells, and the odometry since.
double LandmarkSightings::deviation_of(const FreshReading& reading) const {
  return std::hypot(0.03 + 0.01 * reading.range_m, 0.03 * (driven_m_ - reading.driven_m));
}

void LandmarkSightings::assign(const FreshReading& reading, const Scene& scene, std::vector<FreshReading>& walls) {
  const Pose2 T_map_sensor = scene.sensor_at(reading, scene.T_map_robot);
  const double reach_m = reading.range_m + scene.gate_m;
  Anchor* nearest = nullptr;
  double nearest_m = std::numeric_limits<double>::infinity();
  double next_m = std::numeric_limits<double>::infinity();
  for (auto& [id, anchor] : anchors_) {
    if (anchor.contour == nullptr) continue;
    const auto echo = expected_echo(*anchor.contour, inverse(anchor.T_map_landmark) * T_map_sensor, reading.half_beam_rad);
    if (!echo || echo->range_m >= next_m) continue;
    next_m = std::max(echo->range_m, nearest_m);
    if (echo->range_m >= nearest_m) continue;
    nearest_m = echo->range_m;
    nearest = &anchor;
  }
  const auto wall = anchor_map_.nearest(T_map_sensor, kWideRatio * reading.half_beam_rad, reach_m);
  if (nearest != nullptr) {
    const bool is_hidden = wall && wall->range_m < nearest_m - kInFront_m;
    const bool competes = next_m < nearest_m + kApart_m;
    if (!is_hidden) {
      if (!competes && std::abs(reading.range_m - nearest_m) <= scene.gate_m) nearest->readings.push_back(reading);
      return;
    }
  }
  if (!wall || reading.half_beam_rad <= 0.0 || std::abs(wall->bearing_rad) > kRimRatio * reading.half_beam_rad ||
      std::abs(reading.range_m - wall->range_m) > scene.gate_m)
    return;
  const double bearing_rad = T_map_sensor.theta_rad + wall->bearing_rad;
  const Point hit_m = T_map_sensor.position() + wall->range_m * Point(std::cos(bearing_rad), std::sin(bearing_rad));
  for (const auto& [id, anchor] : anchors_)
    if (anchor.contour != nullptr &&
        anchor.contour->signed_distance(inverse(anchor.T_map_landmark) * hit_m) < kOwnCells_m)
      return;
  walls.push_back(reading);
}

void LandmarkSightings::find_by_landmark(LandmarkId id, Anchor& anchor, const Scene& scene) {
  if (anchor.readings.empty()) return;
  const double now_s = window_begin_s_;
  std::erase_if(anchor.readings, [&](const FreshReading& r) { return r.stamp_s < now_s - kLandmarkWindow_s; });
  if (anchor.readings.size() < kLandmarkReadings) return;
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
    tell(id, anchor.T_map_landmark, anchor.variance_m2, scene, *found);
  anchor.readings.clear();
}

void LandmarkSightings::find_by_walls(const std::vector<FreshReading>& walls, const Scene& scene) {
  const auto compare = [&](int i, const Pose2& T_map_robot) -> std::optional<RangeResidual> {
    const FreshReading& reading = walls[static_cast<std::size_t>(i)];
    const Pose2 T_map_sensor = scene.sensor_at(reading, T_map_robot);
    const auto wall = anchor_map_.nearest(T_map_sensor, reading.half_beam_rad, reading.range_m + scene.gate_m);
    if (!wall) return std::nullopt;
    const double bearing_rad = T_map_sensor.theta_rad + wall->bearing_rad;
    const Point away(-std::cos(bearing_rad), -std::sin(bearing_rad));
    return RangeResidual{reading.range_m - wall->range_m,
                         per_shift_of(away, 0.0, T_map_robot, T_map_sensor.position()), deviation_of(reading)};
  };
  if (const auto found = align(scene.T_map_robot, static_cast<int>(walls.size()), compare))
    tell(0, scene.T_map_robot, 0.0, scene, *found);
}

void LandmarkSightings::tell(LandmarkId id, const Pose2& T_map_landmark, double variance_m2, const Scene& scene,
                             const Alignment& found) {
  LandmarkSighting seen;
  seen.landmark = id;
  seen.T_map_landmark = T_map_landmark;
  seen.T_robot_landmark = inverse(scene.T_map_robot * found.T_from_to) * T_map_landmark;
  // A robot that is moved sees the landmark move the other way.
  Eigen::Matrix3d turned = -Eigen::Matrix3d::Identity();
  turned(0, 2) = seen.T_robot_landmark.y_m;
  turned(1, 2) = -seen.T_robot_landmark.x_m;
  seen.covariance = turned * found.covariance * turned.transpose();
  seen.covariance(0, 0) += variance_m2;
  seen.covariance(1, 1) += variance_m2;
  seen.covariance = (0.5 * (seen.covariance + seen.covariance.transpose())).eval();
  told_.push_back(seen);
}

}  // namespace cairn
