// Landmarks and routes as classes with read-only fields: of a saved map, and of what a module is shown.
#pragma once

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "maps/landmarks/landmark_graph.hpp"
#include "python/shared/pose_arrays.hpp"

namespace cairn::python {

// extra: pybind11::module_local() where the class is known to one library only.
template <class... Extra>
void add_landmark(pybind11::handle scope, const Extra&... extra) {
  namespace py = pybind11;
  py::class_<Landmark>(scope, "Landmark", "A landmark of a map.", extra...)
      .def_readonly("id", &Landmark::id)
      .def_readonly("name", &Landmark::name)
      .def_property_readonly(
          "label", [](const Landmark& landmark) { return label_of(landmark); }, "Its name, or L<id>.")
      .def_readonly("category", &Landmark::category)
      .def_property_readonly(
          "pose", [](const Landmark& landmark) { return tuple_of(landmark.T_map_landmark); },
          "(x m, y m, heading rad) in the map.")
      .def_property_readonly(
          "approach_pose", [](const Landmark& landmark) { return tuple_of(landmark.approach_pose()); },
          "Where a robot stands to be at it: (x m, y m, heading rad).")
      .def_property_readonly(
          "marker",
          [](const Landmark& landmark) {
            return landmark.marker ? std::optional(std::pair(name_of(landmark.marker->family), landmark.marker->number))
                                   : std::nullopt;
          },
          "Of a printed tag, its family and number: (\"36h11\", 7); else None.")
      .def_readonly("degree", &Landmark::degree, "Of its best matching, 0 to 1.")
      .def_readonly("sightings", &Landmark::sightings)
      .def_readonly("level", &Landmark::level)
      .def("__repr__", [](const Landmark& landmark) {
        return "<Landmark " + label_of(landmark) + (landmark.category.empty() ? "" : ", a " + landmark.category) + ">";
      });
}

template <class... Extra>
void add_route(pybind11::handle scope, const Extra&... extra) {
  namespace py = pybind11;
  py::class_<Route>(scope, "Route", "A route from a landmark to another; it is directed.", extra...)
      .def_readonly("id", &Route::id)
      .def_readonly("from_", &Route::from, "Id of the landmark where it begins.")
      .def_readonly("to", &Route::to, "Id of the landmark where it ends.")
      .def_readonly("cost_m", &Route::cost_m)
      .def_readonly("driven", &Route::driven, "The robot has driven it; otherwise planned or imported.")
      .def_readonly("closed", &Route::closed)
      .def_readonly("level", &Route::level)
      .def_readonly("speed_limit_mps", &Route::speed_limit_mps)
      .def_property_readonly(
          "trajectory", [](const Route& route) { return array_of(route.trajectory); },
          "(N, 3) float64: x m, y m, heading rad; N is 0 where only the cost is known.")
      .def("__repr__", [](const Route& route) {
        return "<Route R" + std::to_string(route.id) + " from L" + std::to_string(route.from) + " to L" +
               std::to_string(route.to) + ">";
      });
}

// As a list, by rising id. entries: a map from ids.
template <class Entries>
[[nodiscard]] pybind11::list values_of(const Entries& entries) {
  pybind11::list values;
  for (const auto& [id, value] : entries) values.append(value);
  return values;
}

}  // namespace cairn::python
