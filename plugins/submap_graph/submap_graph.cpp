#include "plugins/submap_graph/submap_graph.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

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
  KeptSubmaps kept;
  const TiedGraph& graph = graph_.graph();
  const auto number_of = [](std::size_t node) { return static_cast<std::int64_t>(node); };
  kept.nodes.reserve(graph.size());
  for (std::size_t node = 0; node < graph.size(); ++node)
    kept.nodes.push_back({number_of(node), node_stamps_s_[node], graph_.T_map(node)});
  kept.edges.reserve(graph.ties().size() + graph.closures().size());
  for (const PoseEdge& tie : graph.ties())
    kept.edges.push_back({number_of(tie.from), number_of(tie.to), tie.T_from_to, tie.information, false, true});
  for (std::size_t i = 0; i < graph.closures().size(); ++i) {
    const Closure& closure = graph.closures()[i];
    kept.edges.push_back({number_of(closure.anchor), number_of(closure.node), closure.T_anchor_node,
                          closure.information, true, graph.is_believed()[i]});
  }
  const auto is_unknown = [&](const auto& submap) { return submap->anchor() >= graph.size(); };
  const auto& all = graph_.local_map().submaps();
  const auto end = std::find_if(all.begin(), all.end(), is_unknown);
  const std::span submaps(all.begin(), end);
  const std::size_t first = submaps.size() - std::min(submaps.size(), KeptSubmaps::kMax);
  for (std::size_t i = first; i < submaps.size(); ++i) {
    KeptSubmap submap{.anchor = number_of(submaps[i]->anchor()),
                      .finished = i < graph_.local_map().finished(),
                      .cell_m = kFieldCell_m};
    set_echoes(submap, submaps[i]->points_m());
    kept.submaps.push_back(std::move(submap));
  }
  return kept;
}

}  // namespace cairn::submap_graph
