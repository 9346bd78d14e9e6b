#include "framework/landmarks/driven_path.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

namespace cairn {
namespace {

constexpr double kThinning_m = 0.05;
constexpr double kVisit_m = 0.25;  // this near to a place counts as having been there

bool is_near(const Pose2& a, const Pose2& b) {
  return (a.position() - b.position()).norm() <= kVisit_m;
}

}  // namespace

std::vector<Pose2> reversed(std::vector<Pose2> path) {
  std::reverse(path.begin(), path.end());
  for (Pose2& pose : path) pose.theta_rad = wrap_angle(pose.theta_rad + std::numbers::pi);
  return path;
}

void DrivenPath::record(const Pose2& T_map_robot) {
  if (poses_.empty() || (poses_.back().position() - T_map_robot.position()).norm() >= kThinning_m)
    poses_.push_back(T_map_robot);
}

std::vector<Pose2> DrivenPath::between(const Pose2& from, const Pose2& to) const {
  std::optional<std::size_t> last_from;
  std::optional<std::size_t> last_to;
  std::size_t best_begin = 0;
  std::size_t best_end = 0;
  bool backwards = false;
  std::size_t best_steps = poses_.size() + 1;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (is_near(poses_[i], from)) last_from = i;
    if (is_near(poses_[i], to)) last_to = i;
    if (!last_from || !last_to) continue;
    const std::size_t begin = std::min(*last_from, *last_to);
    const std::size_t end = std::max(*last_from, *last_to);
    if (end - begin >= best_steps) continue;
    best_steps = end - begin;
    best_begin = begin;
    best_end = end;
    backwards = *last_to < *last_from;
  }
  if (best_steps > poses_.size()) return {};
  const auto at = [&](std::size_t i) { return poses_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<Pose2> stretch(at(best_begin), at(best_end) + 1);
  if (backwards) stretch = reversed(std::move(stretch));
  stretch.insert(stretch.begin(), from);
  stretch.push_back(to);
  return stretch;
}

}  // namespace cairn
