#include "plugins/common/frames/static_frames.hpp"

#include <cmath>
#include <set>

namespace cairn::frames {
namespace {

constexpr double kFarthest_m = 100.0;  // of a sensor from its robot
constexpr double kMinLevel = 0.5;      // of the axis, seen from above

}  // namespace

bool StaticFrames::add(const std::string& parent, const std::string& child, const Eigen::Vector3d& position_m,
                       const Eigen::Quaterniond& rotation) {
  const double size = rotation.squaredNorm();
  if (parent.empty() || child.empty() || parent == child) return false;
  const bool is_near = position_m.allFinite() && position_m.cwiseAbs().maxCoeff() <= kFarthest_m;
  if (!is_near || !(size > 0.5 && size < 2.0)) return false;
  if (!frames_.contains(child) && frames_.size() >= kMaxFrames) return false;
  frames_[child] = {parent, Eigen::Translation3d(position_m) * rotation.normalized()};
  return true;
}

std::optional<StaticFrames::FromRoot> StaticFrames::from_root(std::string frame) const {
  Eigen::Isometry3d T_above_frame = Eigen::Isometry3d::Identity();
  for (std::size_t step = 0; step <= kMaxFrames; ++step) {
    const auto found = frames_.find(frame);
    if (found == frames_.end()) return FromRoot{frame, T_above_frame};
    T_above_frame = found->second.T_parent_frame * T_above_frame;
    frame = found->second.parent;
  }
  return std::nullopt;
}

std::optional<Mounted> StaticFrames::find(const std::string& base, const std::string& sensor) const {
  const std::optional<FromRoot> of_base = from_root(base);
  const std::optional<FromRoot> of_sensor = from_root(sensor);
  if (!of_base || !of_sensor || of_base->root != of_sensor->root) return std::nullopt;
  const Eigen::Isometry3d T_base_sensor = of_base->T_root_frame.inverse() * of_sensor->T_root_frame;
  const Eigen::Vector3d axis = T_base_sensor.linear().col(0);
  if (std::hypot(axis.x(), axis.y()) < kMinLevel) return std::nullopt;
  const Eigen::Vector3d at_m = T_base_sensor.translation();
  return Mounted{{at_m.x(), at_m.y(), std::atan2(axis.y(), axis.x())}, T_base_sensor.linear()(2, 2) < 0.0};
}

std::vector<std::string> StaticFrames::names() const {
  std::set<std::string> all;
  for (const auto& [name, frame] : frames_) all.insert({name, frame.parent});
  return {all.begin(), all.end()};
}

}  // namespace cairn::frames
