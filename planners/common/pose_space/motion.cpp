#include "planners/common/pose_space/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

// sin(x) / x
double sinc(double x) {
  return std::abs(x) < 1e-4 ? 1.0 - x * x / 6.0 : std::sin(x) / x;
}

struct TurnDriveTurn {
  double first_rad = 0.0;
  double length_m = 0.0;
  double last_rad = 0.0;

  TurnDriveTurn(const Pose2& from, const Pose2& to, Driving driving) {
    const Point drive = to.position() - from.position();
    length_m = drive.norm();
    if (length_m == 0.0) {
      first_rad = wrap_angle(to.theta_rad - from.theta_rad);
      return;
    }
    face(from, to, driving == Driving::backwards ? Point(-drive) : drive);
    if (driving == Driving::either) {
      TurnDriveTurn reverse = *this;
      reverse.face(from, to, -drive);
      if (reverse.turned_rad() < turned_rad()) {
        *this = reverse;
        driving = Driving::backwards;
      }
    }
    if (driving == Driving::backwards) length_m = -length_m;
  }
  [[nodiscard]] double turned_rad() const { return std::abs(first_rad) + std::abs(last_rad); }

 private:
  void face(const Pose2& from, const Pose2& to, const Point& facing) {
    const double heading_rad = std::atan2(facing.y(), facing.x());
    first_rad = wrap_angle(heading_rad - from.theta_rad);
    last_rad = wrap_angle(to.theta_rad - heading_rad);
  }
};

}  // namespace

Pose2 driven(const Pose2& from, const MotionElement& element) {
  // The chord of an arc has this length and the mean heading: no difference of large numbers when the
  // arc is nearly straight.
  const double chord_m = element.length_m * sinc(0.5 * element.turn_rad);
  const double heading_rad = from.theta_rad + 0.5 * element.turn_rad;
  return {from.x_m + chord_m * std::cos(heading_rad), from.y_m + chord_m * std::sin(heading_rad),
          wrap_angle(from.theta_rad + element.turn_rad)};
}

bool are_alike(const Pose2& a, const Pose2& b, double within) {
  return (a.position() - b.position()).norm() <= within && std::abs(wrap_angle(a.theta_rad - b.theta_rad)) <= within;
}

Motion::Motion(const Pose2& start, const std::vector<MotionElement>& elements, double spot_turn_m)
    : spot_turn_m_(spot_turn_m), starts_{start} {
  if (!(spot_turn_m > 0.0))
    throw std::invalid_argument(fmt::format("Motion: spot_turn_m must be positive, got {:f}", spot_turn_m));
  elements_.reserve(elements.size());
  starts_.reserve(elements.size() + 1);
  for (const MotionElement& element : elements) append(element);
}

void Motion::append(const MotionElement& element) {
  if (element.length_m == 0.0 && element.turn_rad == 0.0) return;
  elements_.push_back(element);
  starts_.push_back(driven(starts_.back(), element));
}

bool Motion::is_finite() const {
  return cairn::is_finite(start()) && cairn::is_finite(end());
}

double Motion::length_m() const {
  double sum_m = 0.0;
  for (const MotionElement& element : elements_) sum_m += std::abs(element.length_m);
  return sum_m;
}

double Motion::spot_turn_rad() const {
  double sum_rad = 0.0;
  for (const MotionElement& element : elements_)
    if (element.is_turn_on_the_spot()) sum_rad += std::abs(element.turn_rad);
  return sum_rad;
}

int Motion::reversals() const {
  int count = 0;
  double before_m = 0.0;
  for (const MotionElement& element : elements_) {
    if (element.is_turn_on_the_spot()) continue;
    count += before_m * element.length_m < 0.0;
    before_m = element.length_m;
  }
  return count;
}

double Motion::extent_m() const {
  double sum_m = 0.0;
  for (const MotionElement& element : elements_) sum_m += extent_of(element);
  return sum_m;
}

Pose2 Motion::pose_at(double s_m) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const double extent_m = extent_of(elements_[i]);
    if (s_m < extent_m) return driven(starts_[i], elements_[i].share(std::max(s_m, 0.0) / extent_m));
    s_m -= extent_m;
  }
  return end();
}

std::vector<Pose2> Motion::sampled(double step_m, double step_rad) const {
  std::vector<Pose2> poses{start()};
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const MotionElement& element = elements_[i];
    const double steps =
        std::ceil(std::max({1.0, std::abs(element.length_m) / step_m, std::abs(element.turn_rad) / step_rad}));
    for (double k = 1.0; k < steps; k += 1.0) poses.push_back(driven(starts_[i], element.share(k / steps)));
    poses.push_back(starts_[i + 1]);
  }
  return poses;
}

Motion turn_drive_turn(const Pose2& from, const Pose2& to, Driving driving, double spot_turn_m) {
  const TurnDriveTurn drive(from, to, driving);
  return {from,
          {MotionElement::turn(drive.first_rad), MotionElement::straight(drive.length_m),
           MotionElement::turn(drive.last_rad)},
          spot_turn_m};
}

double turn_drive_turn_m(const Pose2& from, const Pose2& to, Driving driving, double spot_turn_m) {
  const TurnDriveTurn drive(from, to, driving);
  return std::abs(drive.length_m) + spot_turn_m * drive.turned_rad();
}

}  // namespace cairn
