// When a ray last looked into each direction of the robot, to 5 degrees.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>

#include "maps/geometry/pose.hpp"

namespace cairn {

class RayDirections {
 public:
  RayDirections() { stamps_s_.fill(-1e9); }

  void look(double axis_rad, double stamp_s) { stamps_s_[static_cast<std::size_t>(direction_of(axis_rad))] = stamp_s; }
  // Since then, into that direction or one beside it.
  [[nodiscard]] bool have_looked(double at_rad, double since_s) const {
    const int middle = direction_of(at_rad) + kDirections;
    return std::ranges::any_of(std::array{middle - 1, middle, middle + 1}, [&](int direction) {
      return stamps_s_[static_cast<std::size_t>(direction % kDirections)] >= since_s;
    });
  }

 private:
  static constexpr int kDirections = 72;
  [[nodiscard]] static int direction_of(double angle_rad) {
    const double turn = wrap_angle(angle_rad) / (2.0 * std::numbers::pi) + 0.5;
    return std::clamp(static_cast<int>(turn * kDirections), 0, kDirections - 1);
  }

  std::array<double, kDirections> stamps_s_{};
};

}  // namespace cairn
