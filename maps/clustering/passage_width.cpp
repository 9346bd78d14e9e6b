#include "maps/clustering/passage_width.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace cairn {
namespace {

constexpr double kStep_m = 0.1;  // between places that are looked at
constexpr double kLandmark_m = 0.5;
constexpr double kRay_rad = std::numbers::pi / 36;
constexpr int kOblique_rays = 9;  // a passage lies across the direction of travel, 45 deg more or less
constexpr int kBend_rays = 3;     // both its sides are seen in opposite directions, 15 deg more or less

// The grid without the landmarks that stand in it.
class OpenGround {
 public:
  OpenGround(const OccupancyGrid& grid, std::span<const Point> landmarks_m, std::span<const Point> places, double max_m)
      : grid_(grid) {
    const double reach_m = max_m + kLandmark_m;
    for (const Point& landmark : landmarks_m)
      if (std::ranges::any_of(places, [&](const Point& place) { return (place - landmark).norm() < reach_m; }))
        landmarks_m_.push_back(landmark);
  }

  // Along a ray, until a cell that is not open.
  [[nodiscard]] double open_length_m(const Point& from, const Point& direction, double max_m) const {
    const double step_m = grid_.cell_m();
    double length_m = 0.0;
    while (length_m < max_m && is_open(from + length_m * direction)) length_m += step_m;
    return std::min(length_m, max_m);
  }

 private:
  [[nodiscard]] bool is_open(const Point& at) const {
    return grid_.state(grid_.cell_at(at)) == CellState::free || std::ranges::any_of(landmarks_m_, [&](const Point& l) {
             return (at - l).squaredNorm() < kLandmark_m * kLandmark_m;
           });
  }

  const OccupancyGrid& grid_;
  std::vector<Point> landmarks_m_;  // near the trajectory
};

Point across(double heading_rad, int ray) {
  const double angle_rad = heading_rad + std::numbers::pi / 2 + ray * kRay_rad;
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

// Where the rays to the left end, and where those to the right end that are opposite to them.
double width_at(const OpenGround& ground, const Point& at, const Point& along, double max_m) {
  const double heading_rad = std::atan2(along.y(), along.x());
  std::array<double, 2 * kOblique_rays + 1> left_m{};
  double* const left_of_ray = left_m.data() + kOblique_rays;
  for (int ray = -kOblique_rays; ray <= kOblique_rays; ++ray)
    left_of_ray[ray] = ground.open_length_m(at, across(heading_rad, ray), max_m);
  double width_m = max_m;
  const double nearest_m = *std::ranges::min_element(left_m);
  for (int ray = -kOblique_rays - kBend_rays; ray <= kOblique_rays + kBend_rays; ++ray) {
    const Point to_right = -across(heading_rad, ray);
    const double right_m = ground.open_length_m(at, to_right, max_m - nearest_m);
    if (right_m >= max_m - nearest_m) continue;
    for (int opposite = std::max(ray - kBend_rays, -kOblique_rays);
         opposite <= std::min(ray + kBend_rays, kOblique_rays); ++opposite) {
      const double length_m = left_of_ray[opposite];
      if (length_m < max_m)
        width_m = std::min(width_m, (length_m * across(heading_rad, opposite) - right_m * to_right).norm());
    }
  }
  return width_m;
}

// Along the trajectory, kStep_m apart or a little less, ends included.
std::vector<Point> places_along(std::span<const Pose2> trajectory) {
  std::vector<Point> places;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const Point from = trajectory[i - 1].position();
    const Point along = trajectory[i].position() - from;
    const int steps = static_cast<int>(std::ceil(along.norm() / kStep_m));
    for (int step = places.empty() ? 0 : 1; step <= steps; ++step)
      places.emplace_back(from + static_cast<double>(step) / std::max(steps, 1) * along);
  }
  return places;
}

}  // namespace

double passage_width_m(std::span<const Pose2> trajectory, const OccupancyGrid& grid, std::span<const Point> landmarks_m,
                       double max_m) {
  const std::vector<Point> places = places_along(trajectory);
  const OpenGround ground(grid, landmarks_m, places, max_m);
  double width_m = max_m;
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    const Point along = places[i + 1] - places[i - 1];
    if (along.norm() > 0.0) width_m = std::min(width_m, width_at(ground, places[i], along, width_m));
  }
  return width_m;
}

}  // namespace cairn
