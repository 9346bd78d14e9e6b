#include "framework/landmarks/driven_path.hpp"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <optional>

namespace cairn {
namespace {

constexpr double kThinning_m = 0.05;
constexpr double kVisit_m = 0.25;      // this near to a place counts as having been there
constexpr double kMaxGap_m = 0.2;      // that thinning leaves; less than kVisit_m, so that no visit is lost
constexpr double kMaxCorner_m = 0.01;  // off the line that takes a pose's place

bool is_near(const Pose2& a, const Pose2& b) {
  return (a.position() - b.position()).norm() <= kVisit_m;
}

double gap_m(const Pose2& a, const Pose2& b) {
  return (a.position() - b.position()).norm();
}

// Whether the line from before to after shows well enough where the robot was.
bool may_go(const Pose2& before, const Pose2& pose, const Pose2& after) {
  const Point along = after.position() - before.position();
  const Point to = pose.position() - before.position();
  const double length_m = along.norm();
  if (length_m > kMaxGap_m || length_m <= 0.0) return false;
  const double share = to.dot(along) / (length_m * length_m);
  if (share < 0.0 || share > 1.0) return false;
  return (to - share * along).norm() <= kMaxCorner_m;
}

// How many steps of 5 cm lie between two recorded poses.
std::int64_t steps_between(const Pose2& a, const Pose2& b) {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(gap_m(a, b) / kThinning_m));
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
  if (poses_.size() > max_poses_) thin();
}

void DrivenPath::thin() {
  const std::size_t older = poses_.size() / 2;
  std::size_t kept = 1;
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    const bool goes = i % 2 == 1 && i + 1 < older && may_go(poses_[i - 1], poses_[i], poses_[i + 1]);
    if (!goes) poses_[kept++] = poses_[i];
  }
  poses_.resize(kept);
  if (kept <= max_poses_ - max_poses_ / 8) return;
  const std::size_t left = max_poses_ - max_poses_ / 4;
  const auto second = poses_.begin() + 1;
  poses_.erase(second, second + static_cast<std::ptrdiff_t>(kept - left));
}

std::vector<Pose2> DrivenPath::between(const Pose2& from, const Pose2& to) const {
  struct Passed {
    std::size_t pose = 0;
    std::int64_t steps = 0;
  };
  std::optional<Passed> last_from;
  std::optional<Passed> last_to;
  Passed best_begin;
  Passed best_end;
  bool backwards = false;
  std::optional<std::int64_t> best_steps;
  std::int64_t steps = 0;
  // Behind the first pose some may have been forgotten.
  const bool begins_later = poses_.size() > 1 && gap_m(poses_[0], poses_[1]) > kVisit_m;
  for (std::size_t i = begins_later ? 1 : 0; i < poses_.size(); ++i) {
    if (i > 0) steps += steps_between(poses_[i - 1], poses_[i]);
    if (is_near(poses_[i], from)) last_from = {i, steps};
    if (is_near(poses_[i], to)) last_to = {i, steps};
    if (!last_from || !last_to) continue;
    const auto [begin, end] =
        std::minmax(*last_from, *last_to, [](const Passed& a, const Passed& b) { return a.pose < b.pose; });
    if (best_steps && end.steps - begin.steps >= *best_steps) continue;
    best_steps = end.steps - begin.steps;
    best_begin = begin;
    best_end = end;
    backwards = last_to->pose < last_from->pose;
  }
  if (!best_steps) return {};
  const auto at = [&](std::size_t i) { return poses_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<Pose2> stretch(at(best_begin.pose), at(best_end.pose) + 1);
  if (backwards) stretch = reversed(std::move(stretch));
  stretch.insert(stretch.begin(), from);
  stretch.push_back(to);
  return stretch;
}

}  // namespace cairn
