#include "maps/submaps/likelihood_field.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr double kReach_sigmas = 3.0;  // beyond it the likelihood is nought

std::vector<Point> usable(std::span<const Point> points_m) {
  std::vector<Point> usable_m;
  for (const Point& point_m : points_m)
    if (point_m.allFinite() &&
        (usable_m.empty() || (point_m - usable_m.front()).cwiseAbs().maxCoeff() <= LikelihoodField::kMaxReach_m))
      usable_m.push_back(point_m);
  return usable_m;
}

}  // namespace

LikelihoodField::LikelihoodField(std::span<const Point> points_m, double cell_m, double sigma_m) : cell_m_(cell_m) {
  const std::vector<Point> echoes_m = usable(points_m);
  if (echoes_m.empty()) return;
  Point low_m = echoes_m.front();
  Point high_m = low_m;
  for (const Point& echo_m : echoes_m) {
    low_m = low_m.cwiseMin(echo_m);
    high_m = high_m.cwiseMax(echo_m);
  }
  const int reach = static_cast<int>(std::ceil(kReach_sigmas * sigma_m / cell_m));
  first_x_ = cell_of(low_m.x()) - reach;
  first_y_ = cell_of(low_m.y()) - reach;
  width_ = cell_of(high_m.x()) + reach + 1 - first_x_;
  height_ = cell_of(high_m.y()) + reach + 1 - first_y_;
  values_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
  for (const Point& echo_m : echoes_m) add(echo_m, sigma_m, reach);
}

void LikelihoodField::add(const Point& point_m, double sigma_m, int reach) {
  const int middle_x = cell_of(point_m.x());
  const int middle_y = cell_of(point_m.y());
  const double per_variance = -0.5 / (sigma_m * sigma_m);
  for (int y = middle_y - reach; y <= middle_y + reach; ++y) {
    const double dy_m = (y + 0.5) * cell_m_ - point_m.y();
    for (int x = middle_x - reach; x <= middle_x + reach; ++x) {
      const double dx_m = (x + 0.5) * cell_m_ - point_m.x();
      const auto value =
          static_cast<std::uint8_t>(std::lround(255.0 * std::exp(per_variance * (dx_m * dx_m + dy_m * dy_m))));
      std::uint8_t& cell = values_[static_cast<std::size_t>(y - first_y_) * static_cast<std::size_t>(width_) +
                                   static_cast<std::size_t>(x - first_x_)];
      cell = std::max(cell, value);
    }
  }
}

}  // namespace cairn
