// The line on which the robot approaches a landmark, and what its latest echoes say about that line.
#pragma once

#include <cmath>
#include <deque>
#include <optional>

#include "framework/config/fields.hpp"
#include "framework/contracts/world_view.hpp"

namespace cairn::behaviours {

// From the landmark's centre outward.
struct DockAxis {
  Point centre{0.0, 0.0};
  double outward_rad = 0.0;
  [[nodiscard]] Point outward() const { return {std::cos(outward_rad), std::sin(outward_rad)}; }
  [[nodiscard]] double along_m(const Point& p) const { return (p - centre).dot(outward()); }
  // To the left of who looks outward.
  [[nodiscard]] double aside_m(const Point& p) const {
    return (p - centre).dot(Point(-std::sin(outward_rad), std::cos(outward_rad)));
  }
};

struct ApproachEchoSettings {
  double straight_rad = radians(20.0);
  double same_rad = radians(1.0);
  int echoes = 7;
  int min_echoes = 3;
  double past_m = 0.05;
  double before_m = 0.25;
};

class AxisEchoes {
 public:
  explicit AxisEchoes(const ApproachEchoSettings& settings) : settings_(settings) {}

  // Every tick of the approach. mapped_m: from the centre to the outline, as the map has it.
  void see(const WorldView& world, const DockAxis& axis, double mapped_m);
  void forget() { echoes_m_.clear(); }

  // From the centre to the outline, by the echoes; none while there are too few.
  [[nodiscard]] std::optional<double> outline_m() const;
  // Since when something has stood between the robot and the landmark; none: nothing does.
  [[nodiscard]] std::optional<double> between_since_s() const { return between_since_s_; }

 private:
  ApproachEchoSettings settings_;
  std::deque<double> echoes_m_;  // of the outline, along the axis
  std::optional<double> between_since_s_;
  int between_sensor_ = -1;  // the transducer that reported it: only the same one can report that it has gone
};

}  // namespace cairn::behaviours
