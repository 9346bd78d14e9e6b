#include "maps/grid/coarse_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace cairn {
namespace {

constexpr int kLargestN = 1024;  // keeps the sums of one coarse cell well inside 32 bits
constexpr std::int32_t kToRecompute = -1;

constexpr int floor_divide(int a, int n) {
  return a >= 0 ? a / n : -((n - 1 - a) / n);
}

CellBox box_of(Cell c) {
  return {c, {c.x + 1, c.y + 1}};
}

}  // namespace

CoarseGrid::CoarseGrid(int n, double alpha) : n_(n), alpha_(alpha) {
  if (n < 1 || n > kLargestN) throw std::invalid_argument(fmt::format("CoarseGrid: n must be in [1, 1024], got {}", n));
  if (!(alpha > 1.0)) throw std::invalid_argument(fmt::format("CoarseGrid: alpha must be above 1, got {:f}", alpha));
}

std::vector<Cell> CoarseGrid::update(const OccupancyGrid& grid, const CellChanges& changes) {
  std::vector<Cell> touched;
  update(grid, changes, touched);
  return touched;
}

void CoarseGrid::update(const OccupancyGrid& grid, const CellChanges& changes, std::vector<Cell>& touched) {
  include(grid.bounds(), grid);
  touched.clear();
  const CellBox fine_bounds =
      bounds_.empty() ? CellBox{} : CellBox{fine_box(bounds_.min).min, fine_box(bounds_.max).min};
  for (const CellSpan& span : changes.spans) {
    const int begin = std::max(span.x_begin, fine_bounds.min.x);
    const int end = std::min(span.x_end, fine_bounds.max.x);
    if (begin >= end || span.y < fine_bounds.min.y || span.y >= fine_bounds.max.y) continue;
    const Cell first = coarse_of({begin, span.y});
    const Cell last = coarse_of({end - 1, span.y});
    for (int x = first.x; x <= last.x; ++x) {
      Sums& sums = sums_[index_of({x, first.y})];
      // Most rows of a change lie over the same coarse cells as the row before.
      if (sums.high_count == kToRecompute) continue;
      sums.high_count = kToRecompute;
      touched.push_back({x, first.y});
    }
  }
  for (const Cell c : touched) sums_[index_of(c)] = sums_of(grid, c);
  std::sort(touched.begin(), touched.end(), [](Cell a, Cell b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
}

void CoarseGrid::rebuild(const OccupancyGrid& grid) {
  bounds_ = {};
  sums_.clear();
  include(grid.bounds(), grid);
}

double CoarseGrid::ol(Cell coarse) const {
  if (!bounds_.contains(coarse)) return kUnknownOl;
  const Sums& s = sums_[index_of(coarse)];
  const double weight = (n_ * n_ - s.high_count) + alpha_ * s.high_count;
  return (s.low_sum + alpha_ * s.high_sum) / weight;
}

Cell CoarseGrid::coarse_of(Cell fine) const {
  return {floor_divide(fine.x, n_), floor_divide(fine.y, n_)};
}

CellBox CoarseGrid::fine_box(Cell coarse) const {
  return {{coarse.x * n_, coarse.y * n_}, {(coarse.x + 1) * n_, (coarse.y + 1) * n_}};
}

void CoarseGrid::include(const CellBox& fine_box, const OccupancyGrid& grid) {
  if (fine_box.empty()) return;
  const CellBox wanted =
      united(box_of(coarse_of(fine_box.min)), box_of(coarse_of({fine_box.max.x - 1, fine_box.max.y - 1})));
  const CellBox old_bounds = bounds_;
  const CellBox new_bounds = united(old_bounds, wanted);
  if (new_bounds == old_bounds) return;

  bounds_ = new_bounds;
  std::vector<Sums> old_sums(static_cast<std::size_t>(bounds_.width()) * static_cast<std::size_t>(bounds_.height()));
  old_sums.swap(sums_);
  std::size_t from = 0;
  for (int y = bounds_.min.y; y < bounds_.max.y; ++y)
    for (int x = bounds_.min.x; x < bounds_.max.x; ++x)
      sums_[index_of({x, y})] = old_bounds.contains({x, y}) ? old_sums[from++] : sums_of(grid, {x, y});
}

CoarseGrid::Sums CoarseGrid::sums_of(const OccupancyGrid& grid, Cell coarse) const {
  const CellBox below = fine_box(coarse);
  std::array<std::uint8_t, kLargestN> values;  // as many rows at a time as fit
  const int rows = kLargestN / n_;
  Sums sums;
  for (int y = below.min.y; y < below.max.y; y += rows) {
    const CellBox some{{below.min.x, y}, {below.max.x, std::min(y + rows, below.max.y)}};
    const std::span<std::uint8_t> read =
        std::span(values).first(static_cast<std::size_t>(n_) * static_cast<std::size_t>(some.height()));
    grid.copy_ol(some, read);
    for (const std::int32_t ol : read) {
      const std::int32_t is_high = ol > kUnknownOl ? 1 : 0;
      sums.low_sum += ol * (1 - is_high);
      sums.high_sum += ol * is_high;
      sums.high_count += is_high;
    }
  }
  return sums;
}

std::size_t CoarseGrid::index_of(Cell coarse) const {
  return static_cast<std::size_t>(coarse.y - bounds_.min.y) * static_cast<std::size_t>(bounds_.width()) +
         static_cast<std::size_t>(coarse.x - bounds_.min.x);
}

}  // namespace cairn
