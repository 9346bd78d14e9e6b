#include "maps/relocalisation/surroundings.hpp"

#include <cmath>
#include <cstdint>

namespace cairn {
namespace {

enum class Square : std::uint8_t { unknown, free, occupied };

// The squares of a raster over a grid.
class Raster {
 public:
  Raster(const OccupancyGrid& grid, double side_m) : side_m_(side_m) {
    const CellBox box = grid.bounds();
    if (box.empty()) return;
    first_ = square_at(grid.centre_of(box.min));
    const Cell last = square_at(grid.centre_of(box.max - Cell{1, 1}));
    width_ = last.x - first_.x + 1;
    height_ = last.y - first_.y + 1;
    count(grid, box);
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Point middle_m(int column, int row) const {
    return {(first_.x + column + 0.5) * side_m_, (first_.y + row + 0.5) * side_m_};
  }
  [[nodiscard]] Square at(int column, int row) const {
    if (column < 0 || row < 0 || column >= width_ || row >= height_) return Square::unknown;
    const Counts& counts = counts_[index_of(column, row)];
    if (counts.occupied > 0) return Square::occupied;
    return counts.free > 0 && 2 * counts.free >= counts.all ? Square::free : Square::unknown;
  }

 private:
  struct Counts {
    int all = 0;
    int free = 0;
    int occupied = 0;
  };
  [[nodiscard]] std::size_t index_of(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column);
  }
  [[nodiscard]] Cell square_at(const Point& at_m) const {
    return {static_cast<int>(std::floor(at_m.x() / side_m_)), static_cast<int>(std::floor(at_m.y() / side_m_))};
  }
  void count(const OccupancyGrid& grid, const CellBox& box) {
    counts_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x) {
        const Cell square = square_at(grid.centre_of({x, y}));
        Counts& counts = counts_[index_of(square.x - first_.x, square.y - first_.y)];
        const CellState state = grid.state({x, y});
        ++counts.all;
        counts.free += state == CellState::free ? 1 : 0;
        counts.occupied += state == CellState::occupied ? 1 : 0;
      }
  }

  double side_m_;
  Cell first_{0, 0};
  int width_ = 0;
  int height_ = 0;
  std::vector<Counts> counts_;
};

bool is_beside_occupied(const Raster& raster, int column, int row) {
  for (int dy = -2; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx)
      if (raster.at(column + dx, row + dy) == Square::occupied) return true;
  return false;
}

std::vector<Point> thinned(const std::vector<Point>& points_m, std::size_t at_most, const Pose2& T_robot_seen) {
  std::vector<Point> kept_m;
  const std::size_t count = std::min(points_m.size(), at_most);
  for (std::size_t i = 0; i < count; ++i) kept_m.push_back(T_robot_seen * points_m[i * points_m.size() / count]);
  return kept_m;
}

}  // namespace

RasterPoints raster_points(const OccupancyGrid& grid, double raster_m) {
  const Raster raster(grid, raster_m);
  RasterPoints points;
  for (int row = 0; row < raster.height(); ++row)
    for (int column = 0; column < raster.width(); ++column) {
      const Square square = raster.at(column, row);
      if (square == Square::occupied) points.occupied_m.push_back(raster.middle_m(column, row));
      if (square == Square::free) points.free_m.push_back(raster.middle_m(column, row));
    }
  return points;
}

Surroundings surroundings_of(const OccupancyGrid& seen, const Pose2& T_seen_robot,
                             const SurroundingsSettings& settings) {
  const Raster raster(seen, settings.raster_m);
  const int step = std::max(1, static_cast<int>(std::lround(settings.free_raster_m / settings.raster_m)));
  std::vector<Point> occupied_m;
  std::vector<Point> free_m;
  for (int row = 0; row < raster.height(); ++row)
    for (int column = 0; column < raster.width(); ++column) {
      const Square square = raster.at(column, row);
      if (square == Square::occupied) occupied_m.push_back(raster.middle_m(column, row));
      if (square == Square::free && row % step == 0 && column % step == 0 && !is_beside_occupied(raster, column, row))
        free_m.push_back(raster.middle_m(column, row));
    }
  const Pose2 T_robot_seen = inverse(T_seen_robot);
  return {thinned(occupied_m, settings.echoes_at_most, T_robot_seen),
          thinned(free_m, settings.free_at_most, T_robot_seen)};
}

}  // namespace cairn
