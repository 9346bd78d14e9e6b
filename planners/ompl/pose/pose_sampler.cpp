#include <algorithm>
#include <cmath>

#include "planners/ompl/pose/kinematic_spaces.hpp"

namespace cairn {

namespace ob = ompl::base;

PoseSampler::PoseSampler(const ob::StateSpace* space, const DistanceField& field, const PoseDraw& draw,
                         std::uint64_t seed)
    : StateSampler(space), field_(&field), draw_(&draw), generator_(seed) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < draw.guide.size(); ++i)
    guide_ends_m_.push_back(length_m += (draw.guide[i] - draw.guide[i - 1]).norm());
}

double PoseSampler::unit() {
  return static_cast<double>(generator_() >> 11) * 0x1.0p-53;
}

Pose2 PoseSampler::near_guide() {
  const double along_m = unit() * guide_ends_m_.back();
  const auto end = std::upper_bound(guide_ends_m_.begin(), guide_ends_m_.end() - 1, along_m);
  const auto segment = static_cast<std::size_t>(end - guide_ends_m_.begin());
  const Point& from = draw_->guide[segment];
  const Point step = draw_->guide[segment + 1] - from;
  const double before_m = segment == 0 ? 0.0 : guide_ends_m_[segment - 1];
  const double share = step.norm() > 0.0 ? (along_m - before_m) / step.norm() : 0.0;
  const Point at = from + share * step + Point(symmetric(draw_->guide_width_m), symmetric(draw_->guide_width_m));
  return {at.x(), at.y(), std::atan2(step.y(), step.x()) + symmetric(draw_->guide_spread_rad)};
}

void PoseSampler::sampleUniform(ob::State* state) {
  if (!guide_ends_m_.empty() && unit() < draw_->guide_share) {
    set_pose(state, near_guide());
    space_->enforceBounds(state);
    return;
  }
  const NumberedCells& cells = draw_->cells;
  const auto index = static_cast<std::size_t>(unit() * static_cast<double>(cells.size()));
  const Point centre = field_->centre_of(cells[std::min(index, cells.size() - 1)]);
  const double x_m = centre.x() + symmetric(0.5 * field_->cell_m());
  const double y_m = centre.y() + symmetric(0.5 * field_->cell_m());
  set_pose(state, {x_m, y_m, symmetric(std::numbers::pi)});
}

void PoseSampler::sampleUniformNear(ob::State* state, const ob::State* near, double distance_m) {
  Pose2 pose = pose_of(near);
  pose.x_m += symmetric(distance_m);
  pose.y_m += symmetric(distance_m);
  pose.theta_rad += symmetric(std::min(distance_m, std::numbers::pi));
  set_pose(state, pose);
  space_->enforceBounds(state);
}

void PoseSampler::sampleGaussian(ob::State* state, const ob::State* mean, double deviation_m) {
  const auto normal = [&] {
    const double angle_rad = symmetric(std::numbers::pi);
    return deviation_m * std::sqrt(-2.0 * std::log(1.0 - unit())) * std::cos(angle_rad);
  };
  Pose2 pose = pose_of(mean);
  pose.x_m += normal();
  pose.y_m += normal();
  pose.theta_rad += normal();
  set_pose(state, pose);
  space_->enforceBounds(state);
}

}  // namespace cairn
