// A continuous motion of a robot on wheels: straight segments, arcs and turns on the spot, one after another.
//
// Every element is a length driven and a heading turned by, both signed, at a constant rate to each other;
// positions and headings along it follow from that exactly. Lengths are negative in reverse.
#pragma once

#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

struct MotionElement {
  double length_m = 0.0;  // 0: a turn on the spot
  double turn_rad = 0.0;  // anticlockwise; 0: straight

  [[nodiscard]] static MotionElement straight(double length_m) { return {length_m, 0.0}; }
  // radius_m > 0; the turn's sign and the direction of driving say to which side the centre lies.
  [[nodiscard]] static MotionElement arc(double radius_m, double turn_rad, bool forwards = true) {
    return {(forwards ? 1.0 : -1.0) * radius_m * std::abs(turn_rad), turn_rad};
  }
  [[nodiscard]] static MotionElement turn(double turn_rad) { return {0.0, turn_rad}; }

  [[nodiscard]] bool is_turn_on_the_spot() const { return length_m == 0.0; }
  // Of the circle that the robot's origin drives, its centre lying on the robot's y axis at this
  // coordinate; 0 on the spot, infinite when straight.
  [[nodiscard]] double signed_radius_m() const { return length_m / turn_rad; }
  [[nodiscard]] MotionElement share(double share) const { return {share * length_m, share * turn_rad}; }
  bool operator==(const MotionElement&) const = default;
};

// The pose after an element.
[[nodiscard]] Pose2 driven(const Pose2& from, const MotionElement& element);

// In metres and radians.
[[nodiscard]] bool are_alike(const Pose2& a, const Pose2& b, double within);

// Places along a motion are given by s in metres: the length driven, plus spot_turn_m for each radian turned
// on the spot. s below 0 and beyond extent_m() means the ends.
class Motion {
 public:
  Motion() = default;
  explicit Motion(const Pose2& start) : starts_{start} {}
  // Elements that do nothing are left out. Throws std::invalid_argument unless spot_turn_m > 0.
  Motion(const Pose2& start, const std::vector<MotionElement>& elements, double spot_turn_m = 1.0);

  void append(const MotionElement& element);

  [[nodiscard]] const std::vector<MotionElement>& elements() const { return elements_; }
  [[nodiscard]] const Pose2& start() const { return starts_.front(); }
  [[nodiscard]] const Pose2& end() const { return starts_.back(); }
  [[nodiscard]] const Pose2& start_of(std::size_t element) const { return starts_[element]; }
  [[nodiscard]] double extent_of(const MotionElement& element) const {
    return element.is_turn_on_the_spot() ? spot_turn_m_ * std::abs(element.turn_rad) : std::abs(element.length_m);
  }
  [[nodiscard]] bool is_finite() const;
  [[nodiscard]] bool ends_at(const Pose2& pose, double within) const { return are_alike(end(), pose, within); }

  [[nodiscard]] double length_m() const;       // driven, in either direction
  [[nodiscard]] double spot_turn_rad() const;  // of those on the spot
  [[nodiscard]] int reversals() const;         // changes between forwards and backwards
  [[nodiscard]] double extent_m() const;       // the s of the end
  [[nodiscard]] Pose2 pose_at(double s_m) const;

  // Poses on the motion, at most step_m driven and step_rad turned apart; the ends of all elements are
  // among them.
  [[nodiscard]] std::vector<Pose2> sampled(double step_m, double step_rad) const;

 private:
  double spot_turn_m_ = 1.0;
  std::vector<MotionElement> elements_;
  std::vector<Pose2> starts_{Pose2{}};  // of each element, and the end
};

enum class Driving { forwards, backwards, either };

// Turns on the spot to face the other place, drives there, turns to its heading. With `either` the direction
// that turns less, forwards when equal.
[[nodiscard]] Motion turn_drive_turn(const Pose2& from, const Pose2& to, Driving driving = Driving::forwards,
                                     double spot_turn_m = 1.0);
// Its extent_m(), at less cost.
[[nodiscard]] double turn_drive_turn_m(const Pose2& from, const Pose2& to, Driving driving = Driving::forwards,
                                       double spot_turn_m = 1.0);

}  // namespace cairn
