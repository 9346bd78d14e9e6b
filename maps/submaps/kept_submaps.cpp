#include "maps/submaps/kept_submaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kMaxPlace_m = 1e6;

bool has_node(const KeptSubmaps& submaps, std::int64_t number) {
  return std::ranges::binary_search(submaps.nodes, number, {}, &KeptNode::number);
}

std::string fault_of(const KeptSubmap& submap) {
  const auto& [anchor, finished, cell_m, min_x, min_y, width, height, echoes] = submap;
  const std::string name = fmt::format("submap {}", anchor);
  constexpr int kMaxSide = KeptSubmap::kMaxSide;
  if (width < 0 || height < 0 || width > kMaxSide || height > kMaxSide)
    return fmt::format("{} says {} x {} cells; 0 x 0 to {} x {} are allowed", name, width, height, kMaxSide, kMaxSide);
  if (echoes.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    return fmt::format("{} says {} x {} cells and holds {}", name, width, height, echoes.size());
  if (!(cell_m > 0.0 && cell_m <= KeptSubmap::kMaxCell_m))
    return fmt::format("{} has cells of {:g} m; more than 0 and at most {:g} m are allowed", name, cell_m,
                       KeptSubmap::kMaxCell_m);
  if (std::abs(min_x) > kMaxSide || std::abs(min_y) > kMaxSide)
    return fmt::format("{} begins at cell ({}, {}); -{} to {} are allowed", name, min_x, min_y, kMaxSide, kMaxSide);
  return {};
}

bool is_in_a_map(const Pose2& pose) {
  return is_finite(pose) && std::abs(pose.x_m) <= kMaxPlace_m && std::abs(pose.y_m) <= kMaxPlace_m;
}

std::string fault_of(const KeptNode& node) {
  constexpr std::int64_t kMaxNumber = KeptSubmaps::kMaxNumber / 2;
  const auto& [number, stamp_s, T_map_node] = node;
  if (number < 0 || number > kMaxNumber)
    return fmt::format("the number of node {} is none of 0 to {}, which leave numbers for more", number, kMaxNumber);
  if (!std::isfinite(stamp_s)) return fmt::format("node {} has the time {}, which is not finite", number, stamp_s);
  if (!is_in_a_map(T_map_node))
    return fmt::format("node {} is at ({:g}, {:g}) m, {:g} rad; finite ones up to {:g} m are allowed", number,
                       T_map_node.x_m, T_map_node.y_m, T_map_node.theta_rad, kMaxPlace_m);
  return {};
}

std::string fault_of(const KeptEdge& edge, const KeptSubmaps& submaps) {
  const std::string name = fmt::format("the edge from {} to {}", edge.from, edge.to);
  for (const std::int64_t end : {edge.from, edge.to})
    if (!has_node(submaps, end)) return fmt::format("{} lacks an end: there is no node {}", name, end);
  if (!is_finite(edge.T_from_to) || !edge.information.allFinite())
    return name + " has a relation or an information that is not finite";
  return {};
}

}  // namespace

SubmapCounts counts_of(const KeptSubmaps& submaps) {
  SubmapCounts counts{submaps.nodes.size(), submaps.submaps.size(), submaps.edges.size()};
  for (const KeptEdge& edge : submaps.edges) {
    if (!edge.is_closure) continue;
    ++counts.closures;
    counts.closures_believed += edge.is_believed ? 1 : 0;
  }
  return counts;
}

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
    if (std::string fault = fault_of(submaps.nodes[i]); !fault.empty()) return fault;
    if (i > 0 && submaps.nodes[i - 1].number >= submaps.nodes[i].number)
      return fmt::format("node {} follows node {}: numbers must rise", submaps.nodes[i].number,
                         submaps.nodes[i - 1].number);
  }
  for (const KeptSubmap& submap : submaps.submaps) {
    if (std::string fault = fault_of(submap); !fault.empty()) return fault;
    if (!has_node(submaps, submap.anchor))
      return fmt::format("submap {} has no anchor: there is no node {}", submap.anchor, submap.anchor);
  }
  for (const KeptEdge& edge : submaps.edges)
    if (std::string fault = fault_of(edge, submaps); !fault.empty()) return fault;
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
