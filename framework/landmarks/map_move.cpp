#include "framework/landmarks/map_move.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr double kStation_m = 0.25;

}  // namespace

MapMove::MapMove(std::vector<Pose2> before, std::vector<Pose2> after)
    : before_(std::move(before)), after_(std::move(after)) {
  for (std::size_t i = 0; i < before_.size(); ++i)
    if (stations_.empty() || (before_[i].position() - before_[stations_.back()].position()).norm() >= kStation_m)
      stations_.push_back(i);
}

Pose2 MapMove::near(const Point& before_m) const {
  if (stations_.empty()) return {};
  const auto distance2 = [&](std::size_t i) { return (before_[i].position() - before_m).squaredNorm(); };
  return of_pose(*std::ranges::min_element(stations_, {}, distance2));
}

}  // namespace cairn
