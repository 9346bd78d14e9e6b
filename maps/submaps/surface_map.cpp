#include "maps/submaps/surface_map.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

namespace cairn {
namespace {

constexpr double kFarthest_m = 1e5;
constexpr double kFewestOnALine = 4.0;
constexpr double kMaxThickness = 0.15;  // variance across a line, of the variance along it
constexpr double kSlack = 1e-9;

bool is_place(const Point& point_m) {
  return std::abs(point_m.x()) <= kFarthest_m && std::abs(point_m.y()) <= kFarthest_m;
}

struct NormalSum {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  int near = 0;
};

NormalSum compare(const SurfaceMap& map, std::span<const Point> points_m, const Pose2& T_map_scan, double sigma_m,
                  const AlignmentSettings& settings) {
  NormalSum sum;
  const double echo_information = 1.0 / (settings.beams_per_echo * settings.echo_sigma_m * settings.echo_sigma_m);
  for (const Point& point_m : points_m) {
    const Point at_m = T_map_scan * point_m;
    const SurfaceLine* line = map.nearest(at_m);
    if (line == nullptr) continue;
    const double off_m = line->normal.dot(at_m - line->at_m);
    const Point arm_m = at_m - T_map_scan.position();
    const Eigen::Vector3d slope(line->normal.x(), line->normal.y(), line->normal.dot(to_left(arm_m)));
    const double far = off_m / (2.0 * sigma_m);
    const double weight = echo_information / ((1.0 + far * far) * (1.0 + far * far));
    sum.information += weight * slope * slope.transpose();
    sum.gradient += weight * off_m * slope;
    if (std::abs(off_m) <= 3.0 * settings.echo_sigma_m) ++sum.near;
  }
  return sum;
}

Eigen::Vector3d between(const Pose2& from, const Pose2& to) {
  return {to.x_m - from.x_m, to.y_m - from.y_m, wrap_angle(to.theta_rad - from.theta_rad)};
}

}  // namespace

SurfaceMap::Key SurfaceMap::key_of(int x, int y) {
  return static_cast<Key>(x) * (Key{1} << 32) + y;
}

const SurfaceMap::Surface* SurfaceMap::find(int x, int y) const {
  const auto at = cells_.find(key_of(x, y));
  return at == cells_.end() ? nullptr : &at->second;
}

void SurfaceMap::add(std::span<const Point> points_m) {
  std::set<std::pair<int, int>> changed;
  for (const Point& point_m : points_m) {
    if (!is_place(point_m)) continue;
    const int x = cell_of(point_m.x());
    const int y = cell_of(point_m.y());
    Surface& cell = cells_[key_of(x, y)];
    cell.moments.count += 1.0;
    cell.moments.sum_m += point_m;
    cell.moments.squares_m2 += point_m * point_m.transpose();
    cell.mean_m = cell.moments.sum_m / cell.moments.count;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) changed.emplace(x + dx, y + dy);
  }
  for (const auto& [x, y] : changed) fit(x, y);
}

void SurfaceMap::fit(int x, int y) {
  const auto at = cells_.find(key_of(x, y));
  if (at == cells_.end()) return;
  Surface& cell = at->second;
  const Point middle_m = cell.mean_m;
  Moments around;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const Surface* near = find(x + dx, y + dy);
      if (near == nullptr) continue;
      const Moments& m = near->moments;
      around.count += m.count;
      around.sum_m += m.sum_m - m.count * middle_m;
      around.squares_m2 += m.squares_m2 - m.sum_m * middle_m.transpose() - middle_m * m.sum_m.transpose() +
                           m.count * middle_m * middle_m.transpose();
    }
  }
  cell.has_line = false;
  if (around.count < kFewestOnALine) return;
  const Point mean_m = around.sum_m / around.count;
  const Eigen::Matrix2d spread = around.squares_m2 / around.count - mean_m * mean_m.transpose();
  const double half = 0.5 * (spread(0, 0) + spread(1, 1));
  const double apart = std::hypot(0.5 * (spread(0, 0) - spread(1, 1)), spread(0, 1));
  const double along_rad = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  cell.has_line = half + apart > kSlack && half - apart <= kMaxThickness * (half + apart);
  cell.line = {middle_m + mean_m, to_left(unit_vector(along_rad))};
}

const SurfaceLine* SurfaceMap::nearest(const Point& point_m) const {
  if (!is_place(point_m)) return nullptr;
  const int x = cell_of(point_m.x());
  const int y = cell_of(point_m.y());
  const SurfaceLine* line = nullptr;
  double nearest_m2 = 0.0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const Surface* near = find(x + dx, y + dy);
      if (near == nullptr || !near->has_line) continue;
      const double off_m2 = (near->mean_m - point_m).squaredNorm();
      if (line != nullptr && off_m2 >= nearest_m2) continue;
      line = &near->line;
      nearest_m2 = off_m2;
    }
  }
  return line;
}

Alignment align(const SurfaceMap& map, std::span<const Point> points_m, const Pose2& start,
                const PosePrediction& prediction, const AlignmentSettings& settings) {
  constexpr double kStill = 1e-5;
  Alignment aligned{start};
  const Eigen::Matrix3d held = prediction.information + kSlack * Eigen::Matrix3d::Identity();
  double sigma_m = settings.first_sigma_m;
  for (int i = 0; i < settings.iterations; ++i) {
    const NormalSum sum = compare(map, points_m, aligned.T_map_scan, sigma_m, settings);
    const Eigen::Vector3d step = -(held + sum.information).inverse() *
                                 (held * between(prediction.T_map_scan, aligned.T_map_scan) + sum.gradient);
    if (!step.allFinite()) break;
    Pose2& pose = aligned.T_map_scan;
    pose = {pose.x_m + step.x(), pose.y_m + step.y(), wrap_angle(pose.theta_rad + step.z())};
    const bool is_last = sigma_m <= settings.echo_sigma_m;
    sigma_m = std::max(settings.echo_sigma_m, 0.7 * sigma_m);
    if (is_last && step.cwiseAbs().maxCoeff() < kStill) break;
  }
  const NormalSum sum = compare(map, points_m, aligned.T_map_scan, settings.echo_sigma_m, settings);
  aligned.information = sum.information;
  if (!points_m.empty()) aligned.matched_ratio = static_cast<double>(sum.near) / static_cast<double>(points_m.size());
  return aligned;
}

}  // namespace cairn
