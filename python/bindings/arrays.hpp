// Arrays of numbers for Python.
#pragma once

#include "framework/planning/trajectory.hpp"
#include "python/shared/pose_arrays.hpp"

namespace cairn::python {

inline void make_read_only(const pybind11::array& array) {
  pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
}

// (N, 6): time s, x m, y m, heading rad, v m/s, w rad/s.
[[nodiscard]] inline pybind11::array_t<double> array_of(const std::vector<TrajectoryPoint>& points) {
  pybind11::array_t<double> array({static_cast<pybind11::ssize_t>(points.size()), pybind11::ssize_t{6}});
  double* out = array.mutable_data();
  for (const TrajectoryPoint& point : points)
    for (const double value :
         {point.time_s, point.pose.x_m, point.pose.y_m, point.pose.theta_rad, point.v_mps, point.w_radps})
      *out++ = value;
  return array;
}

}  // namespace cairn::python
