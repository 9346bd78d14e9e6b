#include "plugins/p2os_robot/counted_odometry.hpp"

#include <cmath>

namespace cairn::p2os_robot {
namespace {

// Counts wrap round at 15 bits; old microcontrollers do so at 12.
constexpr int kBits15 = 1 << 15;
constexpr int kBits12 = 1 << 12;
// The gap is noticed after less than a second, and the robot's own watchdog stops it two seconds after the last
// command.
constexpr double kMaxGap_m = 1.5;

int wrapped(int counts, int period) {
  const int rest = ((counts % period) + period) % period;
  return rest < period / 2 ? rest : rest - period;
}

}  // namespace

double CountedOdometry::step_m(int from_counts, int to_counts) const {
  const double step_m = wrapped(to_counts - from_counts, kBits15) * units_.position_m;
  const double other_m = wrapped(to_counts - from_counts, kBits12) * units_.position_m;
  return std::abs(step_m) > max_step_m_ && std::abs(other_m) <= max_step_m_ ? other_m : step_m;
}

void CountedOdometry::begin_session(const Units& units) {
  units_ = units;
  is_after_gap_ = true;
}

bool CountedOdometry::counts_anew(const Information& seen) const {
  if (seen.x_counts == 0 && seen.y_counts == 0 && seen.heading_counts == 0) return true;
  return Point(step_m(last_->x, seen.x_counts), step_m(last_->y, seen.y_counts)).norm() > kMaxGap_m;
}

Pose2 CountedOdometry::pose_at(const Information& seen) {
  const double heading_rad = wrap_angle(seen.heading_counts * units_.heading_rad);
  if (last_ && !(is_after_gap_ && counts_anew(seen))) {
    position_m_ += Point(step_m(last_->x, seen.x_counts), step_m(last_->y, seen.y_counts));
  } else {
    T_odom_session_ = pose_ * inverse(Pose2{0.0, 0.0, heading_rad});
    position_m_ = Point::Zero();
  }
  is_after_gap_ = false;
  last_ = Counts{seen.x_counts, seen.y_counts};
  pose_ = T_odom_session_ * Pose2{position_m_.x(), position_m_.y(), heading_rad};
  return pose_;
}

}  // namespace cairn::p2os_robot
