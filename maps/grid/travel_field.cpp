#include "maps/grid/travel_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <queue>
#include <stdexcept>

namespace cairn {
namespace {

// The eight neighbours by rising (y, x); k and 7 - k are opposite.
constexpr Cell kNeighbours[8] = {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}};

// What "within" means for a point on the line between two cells, in cells: both count.
constexpr double kTouch_cells = 1e-9;

bool keeps_clear(const DistanceField& space, Cell cell, float clearance_m) {
  const float d = space.distance_m(cell);
  return d > 0.0F && d >= clearance_m;
}

// A cell to settle as one number: cost above, row-major index below. Costs are not negative, so their
// bits order as they do, and equal costs are settled by rising (y, x).
using Waiting = std::uint64_t;
Waiting waiting(float cost_m, std::size_t index) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(cost_m)} << 32 | index;
}
float cost_of(Waiting cell) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(cell >> 32));
}
std::size_t index_of_waiting(Waiting cell) {
  return static_cast<std::uint32_t>(cell);
}

// Step weights, each asked for once.
class WeightCache {
 public:
  WeightCache(const std::function<double(Cell)>& weight, const CellBox& box)
      : weight_(weight), known_(weight ? static_cast<std::size_t>(box.width()) * box.height() : 0, 0.0F) {}

  float at(Cell cell, std::size_t index) {
    if (!weight_) return 1.0F;
    if (known_[index] == 0.0F) known_[index] = checked(cell);
    return known_[index];
  }

 private:
  float checked(Cell cell) const {
    const double w = weight_(cell);
    if (w >= 1.0 && std::isfinite(w)) return static_cast<float>(w);
    throw std::invalid_argument(
        fmt::format("TravelField: step_weight of cell ({}, {}) must be at least 1, got {:f}", cell.x, cell.y, w));
  }

  const std::function<double(Cell)>& weight_;
  std::vector<float> known_;
};

// Whether a straight or diagonal step ends on a free cell and cuts no corner.
bool step_is_free(Cell from, Cell step, const auto& is_free) {
  if (!is_free(from + step)) return false;
  return step.x == 0 || step.y == 0 || (is_free(from + Cell{step.x, 0}) && is_free(from + Cell{0, step.y}));
}

}  // namespace

TravelField::TravelField(const DistanceField& space, const Point& start_map, double clearance_m,
                         const std::function<double(Cell)>& step_weight, const std::function<bool(Cell)>& enough)
    : box_(space.box()), start_(space.cell_at(start_map)) {
  const auto cells = static_cast<std::size_t>(box_.width()) * static_cast<std::size_t>(box_.height());
  cost_m_.assign(cells, std::numeric_limits<float>::infinity());
  came_from_.assign(cells, -1);
  if (!box_.contains(start_)) return;

  const auto clearance = static_cast<float>(clearance_m);
  const auto is_free = [&](Cell c) { return c == start_ || keeps_clear(space, c, clearance); };
  const auto cell_m = static_cast<float>(space.cell_m());
  const float length_m[2] = {cell_m, cell_m * std::numbers::sqrt2_v<float>};
  WeightCache weights(step_weight, box_);
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> frontier;

  cost_m_[index_of(start_)] = 0.0F;
  frontier.push(waiting(0.0F, index_of(start_)));
  while (!frontier.empty()) {
    const float here_m = cost_of(frontier.top());
    const std::size_t from_index = index_of_waiting(frontier.top());
    frontier.pop();
    if (here_m > cost_m_[from_index]) continue;
    const auto at = static_cast<int>(from_index);
    const Cell from{box_.min.x + at % box_.width(), box_.min.y + at / box_.width()};
    if (enough && enough(from)) return;
    for (int k = 0; k < 8; ++k) {
      const Cell step = kNeighbours[k];
      if (!box_.contains(from + step)) continue;
      const std::size_t to_index = index_of(from + step);
      if (cost_m_[to_index] <= here_m || !step_is_free(from, step, is_free)) continue;
      const float weight = 0.5F * (weights.at(from, from_index) + weights.at(from + step, to_index));
      const float cost = here_m + length_m[step.x != 0 && step.y != 0] * weight;
      if (cost > cost_m_[to_index] || cost <= here_m) continue;
      if (cost < cost_m_[to_index]) {
        frontier.push(waiting(cost, to_index));
      } else if (7 - k >= came_from_[to_index]) {
        continue;  // as good as what is known, from a neighbour further up or right
      }
      cost_m_[to_index] = cost;
      came_from_[to_index] = static_cast<std::int8_t>(7 - k);
    }
  }
}

std::size_t TravelField::index_of(Cell cell) const {
  return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
         static_cast<std::size_t>(cell.x - box_.min.x);
}

float TravelField::cost_m(Cell cell) const {
  return box_.contains(cell) ? cost_m_[index_of(cell)] : std::numeric_limits<float>::infinity();
}

std::vector<Cell> TravelField::path_to(Cell cell) const {
  if (!reaches(cell)) return {};
  std::vector<Cell> path{cell};
  while (path.back() != start_) path.push_back(path.back() + kNeighbours[came_from_[index_of(path.back())]]);
  std::reverse(path.begin(), path.end());
  return path;
}

bool segment_is_clear(const DistanceField& space, const Point& from, const Point& to, double clearance_m) {
  const Point a = (from - space.origin_m()) / space.cell_m();
  const Point b = (to - space.origin_m()) / space.cell_m();
  if (!a.allFinite() || !b.allFinite()) return false;
  const CellBox& box = space.box();
  const double x_low = std::min(a.x(), b.x());
  const double x_high = std::max(a.x(), b.x());
  const double y_low = std::min(a.y(), b.y());
  const double y_high = std::max(a.y(), b.y());
  // Nothing is clear outside the box; this also keeps the casts below in range.
  if (x_low - kTouch_cells < box.min.x || y_low - kTouch_cells < box.min.y || x_high + kTouch_cells >= box.max.x ||
      y_high + kTouch_cells >= box.max.y)
    return false;

  const auto clearance = static_cast<float>(clearance_m);
  const double dx_per_y = y_high > y_low ? (b.x() - a.x()) / (b.y() - a.y()) : 0.0;
  for (int y = static_cast<int>(std::floor(y_low - kTouch_cells)); y <= std::floor(y_high + kTouch_cells); ++y) {
    // The part of the segment in this row, as x.
    double left = x_low;
    double right = x_high;
    if (y_high > y_low) {
      const double x_enter = a.x() + (std::max(y - kTouch_cells, y_low) - a.y()) * dx_per_y;
      const double x_leave = a.x() + (std::min(y + 1 + kTouch_cells, y_high) - a.y()) * dx_per_y;
      left = std::max(left, std::min(x_enter, x_leave));
      right = std::min(right, std::max(x_enter, x_leave));
    }
    const int x_end = static_cast<int>(std::floor(right + kTouch_cells));
    for (int x = static_cast<int>(std::floor(left - kTouch_cells)); x <= x_end; ++x)
      if (!keeps_clear(space, {x, y}, clearance)) return false;
  }
  return true;
}

std::vector<Point> shortened(const DistanceField& space, const std::vector<Point>& path, double clearance_m) {
  if (path.size() < 3) return path;
  // One sweep that stretches each straight piece as far as it goes ...
  std::vector<Point> corners{path.front()};
  for (std::size_t i = 2; i < path.size(); ++i)
    if (!segment_is_clear(space, corners.back(), path[i], clearance_m)) corners.push_back(path[i - 1]);
  corners.push_back(path.back());
  // ... then single corners until none can go: a sweep may have stopped before a bend that straightens again.
  for (bool dropped = true; dropped;) {
    dropped = false;
    for (std::size_t i = 1; i + 1 < corners.size();) {
      if (segment_is_clear(space, corners[i - 1], corners[i + 1], clearance_m)) {
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
        dropped = true;
      } else {
        ++i;
      }
    }
  }
  return corners;
}

}  // namespace cairn
