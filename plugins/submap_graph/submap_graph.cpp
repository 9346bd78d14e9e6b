#include "plugins/submap_graph/submap_graph.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "plugins/submap_graph/saved_graph.hpp"

namespace cairn::submap_graph {
namespace {

constexpr double kFarthest_m = 1e6;  // further out than any robot gets
constexpr double kMatched_ratio = 0.5;

bool is_usable(const Pose2& pose) {
  return is_finite(pose) && std::abs(pose.x_m) <= kFarthest_m && std::abs(pose.y_m) <= kFarthest_m;
}

bool is_usable(const RangeReading& reading, const Config& config) {
  return reading.half_beam_rad <= config.widest_half_beam_rad && std::isfinite(reading.range_m) &&
         reading.range_m >= reading.min_m && reading.range_m < reading.max_m && reading.range_m <= config.longest_m &&
         is_usable(reading.T_robot_sensor);
}

}  // namespace

void gather_points(const Observation& observation, const Config& config, std::vector<Point>& points_m) {
  points_m.clear();
  std::set<std::pair<int, int>> taken;
  for (const RangeReading& reading : observation.ranges) {
    if (!is_usable(reading, config)) continue;
    const Point point_m = reading.T_robot_sensor * Point(reading.range_m, 0.0);
    if (!(point_m.norm() <= 2.0 * config.longest_m)) continue;
    const auto square = [&](double x) { return static_cast<int>(std::floor(x / config.point_spacing_m)); };
    if (config.point_spacing_m > 0.0 && !taken.emplace(square(point_m.x()), square(point_m.y())).second) continue;
    points_m.push_back(point_m);
  }
}

SubmapGraph::SubmapGraph(const Config& config, const Pose2& T_map_start, std::shared_ptr<LoopCloser> closer,
                         const RobotModel& robot, const KeptSubmaps* saved, const StartUncertainty& start)
    : config_(config),
      sweep_(config.sweep_s),
      earlier_(saved == nullptr ? KeptSubmaps{} : *saved),
      graph_(config, T_map_start, std::move(closer), compass_of(config, robot),
             earlier_part_of(earlier_, config, start)) {}

PoseEstimate SubmapGraph::update(const Observation& observation, const KnownMap&) {
  gather_points(observation, config_, points_m_);
  if (is_usable(observation.T_odom_robot) || !T_odom_robot_)
    T_odom_robot_ = is_usable(observation.T_odom_robot) ? observation.T_odom_robot : Pose2{};
  PoseEstimate estimate;
  const bool is_scan = config_.sweep_s <= 0.0 || sweep_.add(points_m_, *T_odom_robot_, observation.stamp_s);
  if (is_scan) {
    const std::span<const Point> scan_m = config_.sweep_s <= 0.0 ? points_m_ : sweep_.take();
    estimate.T_map_robot = graph_.add(scan_m, *T_odom_robot_, observation.stamp_s, observation.compass_rad);
  } else {
    estimate.T_map_robot = graph_.pass(*T_odom_robot_, observation.stamp_s);
  }
  for (const MarkerSighting& sighting : observation.markers) graph_.see(sighting);
  node_stamps_s_.resize(graph_.nodes(), observation.stamp_s);
  estimate.covariance = graph_.covariance();
  if (is_scan) (graph_.matched_ratio() >= kMatched_ratio ? estimate.sightings_used : estimate.sightings_refused) = 1;
  return estimate;
}

KeptSubmaps SubmapGraph::submaps() const {
  return saved_graph(earlier_, graph_, node_stamps_s_, config_);
}

}  // namespace cairn::submap_graph
