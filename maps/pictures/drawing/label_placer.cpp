#include "maps/pictures/drawing/label_placer.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace cairn::pictures {
namespace {

constexpr double kRingCost = 150.0;  // of each step away from what the label names
constexpr double kLabelGapPx = 5.0;
// Right, left, above, below, then the corners: the order breaks ties.
constexpr std::array<std::array<double, 2>, 8> kDirections{
    {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {-1, -1}, {1, 1}, {-1, 1}}};

double area_of(const PixelBox& box) {
  return std::max(0.0, box.width()) * std::max(0.0, box.height());
}

double overlap_of(const PixelBox& a, const PixelBox& b) {
  const Pixel min = a.min.cwiseMax(b.min);
  const Pixel max = a.max.cwiseMin(b.max);
  return min.x() < max.x() && min.y() < max.y() ? area_of({min, max}) : 0.0;
}

// Small boxes along a line.
template <class Take>
void for_each_box_along(std::span<const Pixel> points, Take take) {
  constexpr double kStepPx = 6.0;
  const Pixel half(kStepPx / 2.0, kStepPx / 2.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Pixel along = points[i] - points[i - 1];
    const int steps = std::max(1, static_cast<int>(along.norm() / kStepPx));
    for (int k = 0; k < steps; ++k) {
      const Pixel at = points[i - 1] + along * (static_cast<double>(k) / steps);
      take(PixelBox{at - half, at + half});
    }
  }
}

}  // namespace

LabelPlacer::LabelPlacer(const PixelBox& area, std::function<double(const PixelBox&)> background_cost)
    : area_(area), background_cost_(std::move(background_cost)) {}

void LabelPlacer::avoid(const PixelBox& box, double cost) {
  obstacles_.push_back({box, cost});
}

void LabelPlacer::avoid_line(std::span<const Pixel> points, double cost) {
  for_each_box_along(points, [&](const PixelBox& box) { avoid(box, cost); });
}

void LabelPlacer::keep_line_clear(std::span<const Pixel> points) {
  for_each_box_along(points, [&](const PixelBox& box) { keep_clear(box); });
}

std::optional<PixelBox> LabelPlacer::place(const Pixel& about, double radius_px, const Pixel& size_px, int rings) {
  std::optional<PixelBox> best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int ring = 0; ring < rings; ++ring) {
    const double reach_px = radius_px + kLabelGapPx + ring * 12.0;
    for (std::size_t i = 0; i < kDirections.size(); ++i) {
      // Diagonal labels start where the circle ends.
      const double share = i < 4 ? 1.0 : 0.75;
      const Pixel direction(kDirections[i][0], kDirections[i][1]);
      const Pixel centre = about + direction.cwiseProduct(Pixel(share * reach_px, share * reach_px) + size_px / 2.0);
      const PixelBox box{centre - size_px / 2.0, centre + size_px / 2.0};
      if (!is_clear(box)) continue;
      const double cost = cost_of(box) + ring * kRingCost + static_cast<double>(i) * 2.0;
      if (cost < best_cost) {
        best = box;
        best_cost = cost;
      }
    }
  }
  if (best) keep_clear(*best);
  return best;
}

bool LabelPlacer::is_clear(const PixelBox& box) const {
  return overlap_of(box, area_) >= area_of(box) - 1e-6 &&
         std::ranges::all_of(taken_, [&](const PixelBox& taken) { return overlap_of(box, taken) <= 0.0; });
}

double LabelPlacer::cost_of(const PixelBox& box) const {
  double cost = area_of(box) * background_cost_(box);
  for (const Obstacle& obstacle : obstacles_) cost += obstacle.cost * overlap_of(box, obstacle.box);
  return cost;
}

}  // namespace cairn::pictures
