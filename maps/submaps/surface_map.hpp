// Echoes gathered in cells, each with the line through it and its neighbours, and the alignment of scans with these
// lines: point to line, errors weighted down robustly (Geman and McClure), a prediction held on to.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

struct SurfaceLine {
  Point at_m{0.0, 0.0};
  Point normal{1.0, 0.0};
};

class SurfaceMap {
 public:
  explicit SurfaceMap(double cell_m) : cell_m_(cell_m) {}

  // Points that are not finite, or beyond 100 km, are left out.
  void add(std::span<const Point> points_m);
  // The line of the cell with the nearest mean, of the point's cell and its neighbours; null without one.
  [[nodiscard]] const SurfaceLine* nearest(const Point& point_m) const;
  [[nodiscard]] bool empty() const { return cells_.empty(); }

 private:
  struct Moments {
    double count = 0.0;
    Point sum_m{0.0, 0.0};
    Eigen::Matrix2d squares_m2 = Eigen::Matrix2d::Zero();
  };
  struct Surface {
    Moments moments;
    Point mean_m{0.0, 0.0};
    bool has_line = false;
    SurfaceLine line;
  };
  using Key = std::int64_t;
  [[nodiscard]] static Key key_of(int x, int y);
  [[nodiscard]] int cell_of(double coordinate_m) const { return static_cast<int>(std::floor(coordinate_m / cell_m_)); }
  [[nodiscard]] const Surface* find(int x, int y) const;
  void fit(int x, int y);

  double cell_m_;
  std::unordered_map<Key, Surface> cells_;
};

struct AlignmentSettings {
  double echo_sigma_m = 0.03;   // beyond about three of these an echo counts for little
  double first_sigma_m = 0.2;   // the same in the first step; the others go down from it
  double beams_per_echo = 5.0;  // so many echoes count as one independent one: their errors are alike
  int iterations = 20;
};

struct Alignment {
  Pose2 T_map_scan;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  // of the scan alone, x_m, y_m, theta_rad in the map
  double matched_ratio = 0.0;                             // of the points: near a line, within 3 echo sigmas
};

struct PosePrediction {
  Pose2 T_map_scan;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  // zero: none
};

// The pose near `start` at which the points lie on the lines best, held on to the prediction by its information.
[[nodiscard]] Alignment align(const SurfaceMap& map, std::span<const Point> points_m, const Pose2& start,
                              const PosePrediction& prediction, const AlignmentSettings& settings);

}  // namespace cairn
