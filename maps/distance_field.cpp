#include "maps/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

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
    throw std::invalid_argument("DistanceField: " + std::to_string(free.size()) + " marks for " +
                                std::to_string(cells) + " cells");
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
  // The square of a cell distance is a whole number: rounding to it removes OpenCV's last-bit noise,
  // so that "at least this clearance" means the same everywhere.
  std::transform(distance_cells.begin<float>(), distance_cells.end<float>(), distance_m_.begin(),
                 [this](double d) { return static_cast<float>(std::sqrt(std::floor(d * d + 0.5)) * cell_m_); });
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
