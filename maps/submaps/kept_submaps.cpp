#include "maps/submaps/kept_submaps.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

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
