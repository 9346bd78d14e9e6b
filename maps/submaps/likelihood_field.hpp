// How likely an echo is at a place, by the echoes already known around it: exp(-d^2 / 2 sigma^2) of the distance d to
// the nearest of them, in cells. What scans are matched against.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

class LikelihoodField {
 public:
  // Of these echoes; one that is not finite, or more than kMaxReach_m from the first, is left out. A cell's value is
  // the likelihood at its centre, in 255ths. O(points * (sigma / cell)^2 + cells).
  LikelihoodField(std::span<const Point> points_m, double cell_m, double sigma_m);

  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int first_x() const { return first_x_; }
  [[nodiscard]] int first_y() const { return first_y_; }
  // Cell (x, y) covers [x, x + 1) times the cell's side; 0 outside of the field.
  [[nodiscard]] std::uint8_t value(int x, int y) const {
    const int column = x - first_x_;
    const int row = y - first_y_;
    if (column < 0 || row < 0 || column >= width_ || row >= height_) return 0;
    return values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column)];
  }
  [[nodiscard]] int cell_of(double coordinate_m) const { return static_cast<int>(std::floor(coordinate_m / cell_m_)); }

  static constexpr double kMaxReach_m = 200.0;

 private:
  void add(const Point& point_m, double sigma_m, int reach);

  double cell_m_;
  int first_x_ = 0;
  int first_y_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> values_;
};

}  // namespace cairn
