#include "maps/geometry/map_move.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kStation_m = 0.25;
constexpr std::size_t kSmoothed = 2;  // points to either side

// The same path, with points at most kStation_m apart.
std::vector<Point> closer(std::span<const Point> path) {
  std::vector<Point> points;
  points.reserve(path.size());
  for (const Point& to : path) {
    if (!points.empty()) {
      const Point from = points.back();
      const double pieces = std::ceil((to - from).norm() / kStation_m);
      for (double i = 1.0; i < pieces; i += 1.0) points.push_back(from + (i / pieces) * (to - from));
    }
    points.push_back(to);
  }
  return points;
}

// Two passes of one place may have moved differently: the path shall not jump from one to the other.
std::vector<Point> smoothed(const std::vector<Point>& bends_m) {
  std::vector<Point> means_m;
  means_m.reserve(bends_m.size());
  for (std::size_t i = 0; i < bends_m.size(); ++i) {
    const std::size_t reach = std::min({kSmoothed, i, bends_m.size() - 1 - i});
    Point sum{0.0, 0.0};
    for (std::size_t k = i - reach; k <= i + reach; ++k) sum += bends_m[k];
    means_m.emplace_back(sum / static_cast<double>(2 * reach + 1));
  }
  return means_m;
}

Point middle_of(const std::vector<Point>& points) {
  Point sum{0.0, 0.0};
  for (const Point& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// The rigid motion that brings the one nearest to the other (least squares).
Pose2 best_fit(const std::vector<Point>& before, const std::vector<Point>& after) {
  const Point from = middle_of(before);
  const Point to = middle_of(after);
  double along = 0.0;
  double across = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Point a = before[i] - from;
    const Point b = after[i] - to;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  const Pose2 turn{0.0, 0.0, std::atan2(across, along)};
  const Point shift_m = to - turn * from;
  return {shift_m.x(), shift_m.y(), turn.theta_rad};
}

// What of a motion is not rigid, point by point.
std::vector<Point> bends_of(const std::vector<Point>& before, const std::vector<Point>& after) {
  const Pose2 T = best_fit(before, after);
  std::vector<Point> bends_m;
  bends_m.reserve(before.size());
  for (std::size_t i = 0; i < before.size(); ++i) bends_m.emplace_back(after[i] - T * before[i]);
  return bends_m;
}

}  // namespace

MapMove::MapMove(std::vector<Pose2> before, std::vector<Pose2> after)
    : before_(std::move(before)), after_(std::move(after)) {
  for (std::size_t i = 0; i < before_.size(); ++i)
    if (stations_.empty() || (before_[i].position() - before_[stations_.back()].position()).norm() >= kStation_m)
      stations_.push_back(i);
}

Pose2 MapMove::near(const Point& before_m) const {
  if (stations_.empty()) return {};
  const auto distance2 = [&](std::size_t i) { return (before_[i].position() - before_m).squaredNorm(); };
  return of_pose(*std::ranges::min_element(stations_, {}, distance2));
}

MovedPath moved_path(const MapMove& move, std::span<const Point> path) {
  if (path.empty()) return {};
  const std::vector<Point> before = closer(path);
  std::vector<Point> after;
  after.reserve(before.size());
  for (const Point& p : before) after.emplace_back(move.near(p) * p);
  const Pose2 T = best_fit(before, after);
  MovedPath moved{smoothed(bends_of(before, after)), 0.0};
  for (std::size_t i = 0; i < before.size(); ++i) moved.points[i] += T * before[i];
  for (const Point& bend_m : bends_of(before, moved.points)) moved.bend_m = std::max(moved.bend_m, bend_m.norm());
  return moved;
}

}  // namespace cairn
