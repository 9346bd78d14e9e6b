// Where two wheels have taken a robot, from their tick counts.
#pragma once

#include <vector>

#include "framework/config/fields.hpp"
#include "maps/geometry/pose.hpp"

namespace cairn::lego_log {

struct Wheels {
  double m_per_tick = 0.000349;
  double axle_m = 0.173;  // between the wheels

  static void describe(Fields<Wheels>& fields);
};

class WheelPath {
 public:
  explicit WheelPath(const Wheels& wheels) : wheels_(wheels) {}

  // Counts of both wheels at a time; each step is an arc. Stamps must not go back.
  void add(double stamp_s, double left_ticks, double right_ticks);

  [[nodiscard]] bool empty() const { return steps_.empty(); }
  [[nodiscard]] double last_stamp_s() const { return steps_.back().stamp_s; }
  // The pose at a time, from the first counts on; between two counts as far along the arc as the time is, before
  // the first and after the last count theirs. Needs counts.
  [[nodiscard]] Pose2 at(double stamp_s) const;

 private:
  struct Step {
    double stamp_s = 0.0;
    double left_ticks = 0.0;
    double right_ticks = 0.0;
    Pose2 T_first_robot;
  };
  [[nodiscard]] Pose2 arc(double left_ticks, double right_ticks) const;

  Wheels wheels_;
  std::vector<Step> steps_;
};

}  // namespace cairn::lego_log
