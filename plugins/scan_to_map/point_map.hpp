// Echoes gathered in square cells, each with the line that its echoes lie along.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>

#include "maps/geometry/pose.hpp"

namespace cairn::scan_to_map {

struct Line {
  Point at_m{0.0, 0.0};
  Point normal{1.0, 0.0};
};

class PointMap {
 public:
  explicit PointMap(double cell_m) : cell_m_(cell_m) {}

  // A cell takes kMaxPoints and then stands fast, so that the map cannot creep; what is beyond
  // kFarthest_m, or would be one cell too many, is left out. Allocates for new cells only.
  void add(const Point& point_m);
  // The line through the nearest cell that has one, among the cell of the point and its eight
  // neighbours; nothing when there is none within max_m of the line's middle.
  [[nodiscard]] std::optional<Line> nearest_line(const Point& point_m, double max_m) const;
  [[nodiscard]] std::size_t size() const { return cells_.size(); }

  static constexpr int kMaxPoints = 200;
  static constexpr double kFarthest_m = 1e5;
  static constexpr std::size_t kMaxCells = 4'000'000;

 private:
  struct Points {
    int count = 0;
    Point sum_m{0.0, 0.0};  // from the middle of the cell
    double xx = 0.0, xy = 0.0, yy = 0.0;
    bool has_line = false;
    Line line;
  };
  using Key = std::uint64_t;
  [[nodiscard]] static Key key_of(std::int64_t column, std::int64_t row);
  static void fit(Points& points, const Point& middle_m);

  double cell_m_;
  std::unordered_map<Key, Points> cells_;
};

}  // namespace cairn::scan_to_map
