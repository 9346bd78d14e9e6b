#include "maps/submaps/kept_submaps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cairn {
namespace {

constexpr double kMaxPlace_m = 1e6;

bool has_node(const KeptSubmaps& submaps, std::int64_t number) {
  return std::ranges::binary_search(submaps.nodes, number, {}, &KeptNode::number);
}

std::optional<std::string> fault_of(const KeptSubmap& submap) {
  const std::string name = "submap " + std::to_string(submap.anchor);
  const bool is_grid = submap.width >= 0 && submap.height >= 0 && submap.width <= KeptSubmap::kMaxSide &&
                       submap.height <= KeptSubmap::kMaxSide;
  if (!is_grid ||
      submap.echoes.size() != static_cast<std::size_t>(submap.width) * static_cast<std::size_t>(submap.height))
    return name + " has other cells than it says";
  if (!(submap.cell_m > 0.0 && submap.cell_m <= KeptSubmap::kMaxCell_m) ||
      std::abs(submap.min_x) > KeptSubmap::kMaxSide || std::abs(submap.min_y) > KeptSubmap::kMaxSide)
    return name + " has impossible cells";
  return std::nullopt;
}

bool is_in_a_map(const Pose2& pose) {
  return is_finite(pose) && std::abs(pose.x_m) <= kMaxPlace_m && std::abs(pose.y_m) <= kMaxPlace_m;
}

}  // namespace

void set_echoes(KeptSubmap& submap, std::span<const Point> points_m) {
  constexpr int kHalf = KeptSubmap::kMaxSide / 2;
  std::vector<std::pair<int, int>> cells;  // y, x
  cells.reserve(points_m.size());
  for (const Point& point_m : points_m) {
    const double x = std::floor(point_m.x() / submap.cell_m);
    const double y = std::floor(point_m.y() / submap.cell_m);
    if (std::abs(x) < kHalf && std::abs(y) < kHalf) cells.emplace_back(static_cast<int>(y), static_cast<int>(x));
  }
  submap.min_x = submap.min_y = submap.width = submap.height = 0;
  submap.echoes.clear();
  if (cells.empty()) return;
  const auto [low_y, high_y] = std::ranges::minmax(cells, {}, &std::pair<int, int>::first);
  const auto [low_x, high_x] = std::ranges::minmax(cells, {}, &std::pair<int, int>::second);
  submap.min_x = low_x.second;
  submap.min_y = low_y.first;
  submap.width = high_x.second - low_x.second + 1;
  submap.height = high_y.first - low_y.first + 1;
  submap.echoes.assign(static_cast<std::size_t>(submap.width) * static_cast<std::size_t>(submap.height), 0);
  for (const auto& [y, x] : cells) {
    std::uint8_t& count =
        submap.echoes[static_cast<std::size_t>(y - submap.min_y) * static_cast<std::size_t>(submap.width) +
                      static_cast<std::size_t>(x - submap.min_x)];
    if (count < 255) ++count;
  }
}

std::vector<Point> echoes_of(const KeptSubmap& submap, int max_times) {
  std::vector<Point> points_m;
  const auto width = static_cast<std::size_t>(submap.width);
  for (std::size_t i = 0; i < submap.echoes.size(); ++i) {
    const Point middle_m((submap.min_x + static_cast<double>(i % width) + 0.5) * submap.cell_m,
                         (submap.min_y + static_cast<double>(i / width) + 0.5) * submap.cell_m);
    points_m.insert(points_m.end(), static_cast<std::size_t>(std::min<int>(submap.echoes[i], max_times)), middle_m);
  }
  return points_m;
}

std::span<const KeptNode> nodes_of(const KeptSubmaps& submaps, const KeptSubmap& submap, double submap_m) {
  const auto first = std::ranges::lower_bound(submaps.nodes, submap.anchor, {}, &KeptNode::number);
  auto end = first + 1;
  for (double way_m = 0.0; end != submaps.nodes.end() && way_m < submap_m; ++end) {
    if (end->number != std::prev(end)->number + 1) break;
    const Pose2 step = inverse(std::prev(end)->T_map_node) * end->T_map_node;
    way_m += step.position().norm() + std::abs(step.theta_rad);
  }
  return {first, end};
}

std::string fault_of(const KeptSubmaps& submaps) {
  for (std::size_t i = 0; i < submaps.nodes.size(); ++i) {
    const KeptNode& node = submaps.nodes[i];
    const std::string name = "node " + std::to_string(node.number);
    if (node.number < 0 || node.number > KeptSubmaps::kMaxNumber / 2) return name + " leaves no numbers for more";
    if (!std::isfinite(node.stamp_s)) return name + " has no time";
    if (!is_in_a_map(node.T_map_node)) return name + " is beyond all maps";
    if (i > 0 && submaps.nodes[i - 1].number >= node.number) return name + " comes twice, or too late";
  }
  for (const KeptSubmap& submap : submaps.submaps) {
    if (const auto fault = fault_of(submap)) return *fault;
    if (!has_node(submaps, submap.anchor)) return "submap " + std::to_string(submap.anchor) + " has no anchor";
  }
  for (const KeptEdge& edge : submaps.edges)
    if (!edge.information.allFinite() || !is_finite(edge.T_from_to) || !has_node(submaps, edge.from) ||
        !has_node(submaps, edge.to))
      return "the edge from " + std::to_string(edge.from) + " to " + std::to_string(edge.to) +
             " lacks an end, or says nothing";
  return {};
}

void keep_latest(KeptSubmaps& submaps) {
  if (submaps.empty()) return;
  std::int64_t first = submaps.nodes.front().number;
  if (submaps.submaps.size() > KeptSubmaps::kMax)
    first = submaps.submaps[submaps.submaps.size() - KeptSubmaps::kMax].anchor;
  if (submaps.nodes.size() > KeptSubmaps::kMaxNodes)
    first = std::max(first, submaps.nodes[submaps.nodes.size() - KeptSubmaps::kMaxNodes].number);
  std::erase_if(submaps.nodes, [&](const KeptNode& node) { return node.number < first; });
  std::erase_if(submaps.submaps, [&](const KeptSubmap& submap) { return submap.anchor < first; });
  std::erase_if(submaps.edges, [&](const KeptEdge& edge) { return std::min(edge.from, edge.to) < first; });
  if (submaps.edges.size() > KeptSubmaps::kMaxEdges)
    submaps.edges.erase(submaps.edges.begin(),
                        submaps.edges.end() - static_cast<std::ptrdiff_t>(KeptSubmaps::kMaxEdges));
}

}  // namespace cairn
