#include "maps/grid/distance_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace cairn {
namespace {

std::vector<std::uint8_t> free_cells(const OccupancyGrid& grid, const CellBox& box, UnknownPolicy unknown,
                                     const OccupancyThresholds& thresholds) {
  std::vector<LogOdds> row(static_cast<std::size_t>(box.width()));
  std::vector<std::uint8_t> free;
  free.reserve(row.size() * static_cast<std::size_t>(box.height()));
  for (int y = box.min.y; y < box.max.y; ++y) {
    grid.copy_log_odds({{box.min.x, y}, {box.max.x, y + 1}}, row);
    for (const LogOdds log_odds : row) {
      const CellState state = thresholds.state(log_odds);
      free.push_back(state == CellState::free || (state == CellState::unknown && unknown == UnknownPolicy::allow));
    }
  }
  return free;
}

// The square of a cell distance is a whole number: rounding to it removes OpenCV's last-bit noise,
// so that "at least this clearance" means the same everywhere.
float exact_m(double cells, double cell_m) {
  return static_cast<float>(std::sqrt(std::floor(cells * cells + 0.5)) * cell_m);
}

}  // namespace

DistanceField::DistanceField(const OccupancyGrid& grid, UnknownPolicy unknown, const OccupancyThresholds& thresholds)
    : box_(grid.bounds().empty() ? CellBox{} : grid.bounds().grown(1)),
      cell_m_(grid.cell_m()),
      origin_m_(grid.origin_m()) {
  measure(free_cells(grid, box_, unknown, thresholds));
}

DistanceField::DistanceField(const CellBox& box, double cell_m, const Point& origin_m, std::vector<std::uint8_t> free)
    : box_(box.empty() ? CellBox{} : box), cell_m_(cell_m), origin_m_(origin_m) {
  const std::int64_t cells = std::int64_t{box_.width()} * box_.height();
  if (static_cast<std::int64_t>(free.size()) != cells)
    throw std::invalid_argument(fmt::format("DistanceField: {} marks for {} cells", free.size(), cells));
  measure(std::move(free));
}

void DistanceField::measure(std::vector<std::uint8_t> free) {
  if (box_.empty()) return;
  cv::Mat crossable(box_.height(), box_.width(), CV_8U, free.data());
  distance_m_.resize(crossable.total());
  if (cv::countNonZero(crossable) == static_cast<int>(crossable.total())) {
    const double diagonal_m = std::hypot(box_.width(), box_.height()) * cell_m_;
    std::fill(distance_m_.begin(), distance_m_.end(), static_cast<float>(diagonal_m));
    return;
  }
  cv::Mat distance_cells;
  cv::distanceTransform(crossable, distance_cells, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  std::transform(distance_cells.begin<float>(), distance_cells.end<float>(), distance_m_.begin(),
                 [this](double d) { return exact_m(d, cell_m_); });
}

void DistanceField::follow(const OccupancyGrid& grid, UnknownPolicy unknown, const OccupancyThresholds& thresholds,
                           const CellBox& changed) {
  const CellBox bounds = grid.bounds().empty() ? CellBox{} : grid.bounds().grown(1);
  if (bounds != box_ || grid.cell_m() != cell_m_ || grid.origin_m() != origin_m_) {
    *this = DistanceField(grid, unknown, thresholds);
    return;
  }
  const CellBox within = intersected(changed, box_);
  if (within.empty()) return;
  const CellBox cells = concerned_by(within);
  for (int reach = std::max(cells.width(), cells.height());; reach *= 2) {
    const CellBox window = intersected(box_, cells.grown(reach));
    std::vector<std::uint8_t> free = free_cells(grid, window, unknown, thresholds);
    if (window == box_) {
      measure(std::move(free));
      return;
    }
    if (measure_within(cells, window, std::move(free))) return;
  }
}

// The cells whose nearest blocked cell may be another when those in `changed` are: it was there, or is as far.
CellBox DistanceField::concerned_by(const CellBox& changed) const {
  CellBox cells = changed;
  for (int y = box_.min.y; y < box_.max.y; ++y) {
    const double off_y = std::max({changed.min.y - y, y - (changed.max.y - 1), 0});
    for (int x = box_.min.x; x < box_.max.x; ++x) {
      const double off_x = std::max({changed.min.x - x, x - (changed.max.x - 1), 0});
      const double known = distance_m({x, y}) / cell_m_ + 1e-3;
      if (known * known >= off_x * off_x + off_y * off_y) cells = united(cells, {{x, y}, {x + 1, y + 1}});
    }
  }
  return cells;
}

// Measures the cells by what lies in the window around them; false when something outside might be nearer.
bool DistanceField::measure_within(const CellBox& cells, const CellBox& window, std::vector<std::uint8_t> free) {
  cv::Mat crossable(window.height(), window.width(), CV_8U, free.data());
  if (cv::countNonZero(crossable) == static_cast<int>(crossable.total())) return false;
  cv::Mat distance_cells;
  cv::distanceTransform(crossable, distance_cells, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  constexpr int kNoRim = 1 << 30;  // nothing lies beyond the field's own box
  const auto rim = [&](int at, int low, int high, int box_low, int box_high) {
    return std::min(low == box_low ? kNoRim : at - low + 1, high == box_high ? kNoRim : high - at);
  };
  const auto found = [&](int x, int y) { return distance_cells.at<float>(y - window.min.y, x - window.min.x); };
  for (int y = cells.min.y; y < cells.max.y; ++y)
    for (int x = cells.min.x; x < cells.max.x; ++x) {
      const int outside = std::min(rim(x, window.min.x, window.max.x, box_.min.x, box_.max.x),
                                   rim(y, window.min.y, window.max.y, box_.min.y, box_.max.y));
      if (found(x, y) > static_cast<float>(outside)) return false;
    }
  for (int y = cells.min.y; y < cells.max.y; ++y)
    for (int x = cells.min.x; x < cells.max.x; ++x)
      distance_m_[static_cast<std::size_t>(y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
                  static_cast<std::size_t>(x - box_.min.x)] = exact_m(found(x, y), cell_m_);
  return true;
}

Cell DistanceField::cell_at(const Point& p_map) const {
  return cell_on_lattice(p_map, origin_m_, cell_m_);
}

Point DistanceField::centre_of(Cell cell) const {
  return {origin_m_.x() + (cell.x + 0.5) * cell_m_, origin_m_.y() + (cell.y + 0.5) * cell_m_};
}

double DistanceField::clearance_m(const Point& p_map) const {
  // Half a diagonal for where the point is in its cell, half for where the obstacle is in its own.
  return std::max(0.0, distance_m(cell_at(p_map)) - std::numbers::sqrt2 * cell_m_);
}

}  // namespace cairn
