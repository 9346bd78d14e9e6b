#include "plugins/submap_graph/earlier_part.hpp"

#include <algorithm>

namespace cairn::submap_graph {
namespace {

constexpr int kMaxTimes = 5;  // an echo counts: enough for a wall between two rows of cells
// A robot that was switched off and on stands where it was left up to what it was pushed by.
constexpr double kLeft_m = 0.1;
constexpr double kLeft_rad = radians(2.0);

std::shared_ptr<const Submap> submap_of(const KeptSubmaps& saved, const KeptSubmap& kept, const Config& config) {
  const std::span<const KeptNode> nodes = nodes_of(saved, kept, config.submap_m);
  const auto first = static_cast<std::size_t>(nodes.data() - saved.nodes.data());
  auto submap = std::make_shared<Submap>(first, config.surface_cell_m);
  submap->add(first, Pose2{}, echoes_of(kept, kMaxTimes));
  const Pose2 T_anchor_map = inverse(nodes.front().T_map_node);
  for (std::size_t i = 1; i < nodes.size(); ++i) submap->add(first + i, T_anchor_map * nodes[i].T_map_node, {});
  return submap;
}

}  // namespace

EarlierPart earlier_part_of(const KeptSubmaps& saved, const Config& config, const StartUncertainty& start) {
  EarlierPart earlier;
  earlier.start = start;
  earlier.T_map_node.reserve(saved.nodes.size());
  for (const KeptNode& node : saved.nodes) earlier.T_map_node.push_back(node.T_map_node);
  earlier.submaps.reserve(saved.submaps.size());
  for (const KeptSubmap& kept : saved.submaps) earlier.submaps.push_back(submap_of(saved, kept, config));
  return earlier;
}

double start_drift_m(const EarlierPart& earlier) {
  return earlier.T_map_node.empty() ? 0.0 : 3.0 * earlier.start.position_m;
}

LocalMap::Tie start_tie(const EarlierPart& earlier, const Pose2& T_map_start) {
  const auto away_m = [&](const Pose2& pose) { return (pose.position() - T_map_start.position()).norm(); };
  const auto nearest = std::ranges::min_element(earlier.T_map_node, {}, away_m);
  const double position_m = std::max(kLeft_m, earlier.start.position_m);
  const double heading_rad = std::max(kLeft_rad, earlier.start.heading_rad);
  const Eigen::Vector3d deviations(position_m, position_m, heading_rad);
  return {static_cast<std::size_t>(nearest - earlier.T_map_node.begin()), inverse(*nearest) * T_map_start,
          deviations.cwiseProduct(deviations).cwiseInverse().asDiagonal()};
}

}  // namespace cairn::submap_graph
