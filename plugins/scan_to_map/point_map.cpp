#include "plugins/scan_to_map/point_map.hpp"

#include <cmath>

namespace cairn::scan_to_map {
namespace {

constexpr int kFewestOnALine = 5;
constexpr double kThickest = 0.25;  // a line is at most this thick against its length (variances)

bool is_place(const Point& point_m) {
  return std::abs(point_m.x()) <= PointMap::kFarthest_m && std::abs(point_m.y()) <= PointMap::kFarthest_m;
}

}  // namespace

PointMap::Key PointMap::key_of(std::int64_t column, std::int64_t row) {
  return static_cast<Key>(column) << 32U ^ (static_cast<Key>(row) & 0xffffffffU);
}

void PointMap::add(const Point& point_m) {
  if (!is_place(point_m)) return;
  const auto column = static_cast<std::int64_t>(std::floor(point_m.x() / cell_m_));
  const auto row = static_cast<std::int64_t>(std::floor(point_m.y() / cell_m_));
  const Key key = key_of(column, row);
  auto at = cells_.find(key);
  if (at == cells_.end()) {
    if (cells_.size() >= kMaxCells) return;
    at = cells_.emplace(key, Points{}).first;
  }
  Points& points = at->second;
  if (points.count >= kMaxPoints) return;
  const Point middle_m = cell_m_ * Point(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
  const Point offset_m = point_m - middle_m;
  ++points.count;
  points.sum_m += offset_m;
  points.xx += offset_m.x() * offset_m.x();
  points.xy += offset_m.x() * offset_m.y();
  points.yy += offset_m.y() * offset_m.y();
  fit(points, middle_m);
}

void PointMap::fit(Points& points, const Point& middle_m) {
  if (points.count < kFewestOnALine) return;
  const double n = points.count;
  const Point mean_m = points.sum_m / n;
  const double xx = points.xx / n - mean_m.x() * mean_m.x();
  const double xy = points.xy / n - mean_m.x() * mean_m.y();
  const double yy = points.yy / n - mean_m.y() * mean_m.y();
  const double spread = std::hypot(0.5 * (xx - yy), xy);
  const double longest = 0.5 * (xx + yy) + spread;
  const double thickest = 0.5 * (xx + yy) - spread;
  points.has_line = thickest <= kThickest * longest && longest > 0.0;
  const double along_rad = 0.5 * std::atan2(2.0 * xy, xx - yy);
  points.line = {middle_m + mean_m, {-std::sin(along_rad), std::cos(along_rad)}};
}

std::optional<Line> PointMap::nearest_line(const Point& point_m, double max_m) const {
  if (!is_place(point_m)) return std::nullopt;
  const auto column = static_cast<std::int64_t>(std::floor(point_m.x() / cell_m_));
  const auto row = static_cast<std::int64_t>(std::floor(point_m.y() / cell_m_));
  const Line* nearest = nullptr;
  double nearest_m2 = max_m * max_m;
  for (std::int64_t dy = -1; dy <= 1; ++dy) {
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      const auto at = cells_.find(key_of(column + dx, row + dy));
      if (at == cells_.end() || !at->second.has_line) continue;
      const double off_m2 = (at->second.line.at_m - point_m).squaredNorm();
      if (off_m2 >= nearest_m2) continue;
      nearest = &at->second.line;
      nearest_m2 = off_m2;
    }
  }
  return nearest == nullptr ? std::nullopt : std::optional(*nearest);
}

}  // namespace cairn::scan_to_map
