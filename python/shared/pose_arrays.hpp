// Poses as tuples and arrays of Python.
#pragma once

#include <pybind11/numpy.h>

#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn::python {

// (x m, y m, heading rad).
[[nodiscard]] inline pybind11::tuple tuple_of(const Pose2& pose) {
  return pybind11::make_tuple(pose.x_m, pose.y_m, pose.theta_rad);
}

// (N, 3): x m, y m, heading rad.
[[nodiscard]] inline pybind11::array_t<double> array_of(const std::vector<Pose2>& poses) {
  pybind11::array_t<double> array({static_cast<pybind11::ssize_t>(poses.size()), pybind11::ssize_t{3}});
  double* out = array.mutable_data();
  for (const Pose2& pose : poses) {
    *out++ = pose.x_m;
    *out++ = pose.y_m;
    *out++ = pose.theta_rad;
  }
  return array;
}

}  // namespace cairn::python
