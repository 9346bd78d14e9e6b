// Lays a scan on a likelihood field by trying every pose of a window (Olson, "Real-time correlative scan matching",
// ICRA 2009), all of them or by branch and bound (Hess and others, "Real-time loop closure in 2D LIDAR SLAM", ICRA
// 2016).
//
// Poses lie on a lattice: headings so far apart that the farthest point moves by one cell, positions a cell apart,
// around the window's middle. The score of a pose is the mean likelihood of the scan's points there, from 0 to 1. Among
// poses of one score the first in the order of heading, y, x is taken.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "maps/submaps/likelihood_field.hpp"

namespace cairn {

struct SearchWindow {
  Pose2 T_field_scan;  // the middle
  double half_side_m = 1.0;
  double half_angle_rad = 0.2;
};

struct ScanMatch {
  Pose2 T_field_scan;
  double score = 0.0;
};

// A field and its maxima over squares of 2, 4, 8, ... cells.
class FieldPyramid {
 public:
  FieldPyramid(LikelihoodField field, int levels);

  [[nodiscard]] const LikelihoodField& field() const { return field_; }
  [[nodiscard]] int levels() const { return static_cast<int>(maxima_.size()) + 1; }
  // The greatest value in the square of 2^level cells whose lowest corner is (x, y).
  [[nodiscard]] std::uint8_t greatest(int level, int x, int y) const {
    if (level == 0) return field_.value(x, y);
    const Maxima& maxima = maxima_[static_cast<std::size_t>(level - 1)];
    const int column = x - maxima.first_x;
    const int row = y - maxima.first_y;
    if (column < 0 || row < 0 || column >= maxima.width || row >= maxima.height) return 0;
    return maxima.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(maxima.width) +
                         static_cast<std::size_t>(column)];
  }

 private:
  struct Maxima {
    int first_x = 0;
    int first_y = 0;
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> values;
  };
  void add_level(int level);

  LikelihoodField field_;
  std::vector<Maxima> maxima_;  // of level 1, 2, ...
};

// Points and what they are laid on. Each point of each layer counts alike.
struct SearchLayer {
  const FieldPyramid* pyramid = nullptr;
  std::span<const Point> points_m;
};

struct DistinctRules {
  double min_score = 0.5;
  double min_of_best_ratio = 0.8;  // of the best score
  // Two poses are one when they are nearer than this and turned by less.
  double apart_m = 1.0;
  double apart_rad = 0.5;
  std::size_t at_most = 20;
};

// Mean likelihood of the points at this pose; 0 without points.
[[nodiscard]] double score_of(const LikelihoodField& field, std::span<const Point> points_m, const Pose2& T_field_scan);

// The best pose of the window when its score is at least min_score. Every pose is tried: O(poses * points).
[[nodiscard]] std::optional<ScanMatch> search_all(const LikelihoodField& field, std::span<const Point> points_m,
                                                  const SearchWindow& window, double min_score);
// The same answer, by branch and bound.
[[nodiscard]] std::optional<ScanMatch> search(const FieldPyramid& pyramid, std::span<const Point> points_m,
                                              const SearchWindow& window, double min_score);

// The best pose of the window, then the best of those that are apart from it, and so on, best first. All fields have
// cells of one size. standing: null, or where the scan's origin can be: where the field is not 0. Exact, by branch and
// bound; each further pose costs about as much as the first.
[[nodiscard]] std::vector<ScanMatch> search_distinct(std::span<const SearchLayer> layers, const FieldPyramid* standing,
                                                     const SearchWindow& window, const DistinctRules& rules);

}  // namespace cairn
