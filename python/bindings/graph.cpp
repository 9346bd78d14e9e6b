// Landmarks, routes and clusters as objects with read-only fields.
#include <pybind11/stl.h>

#include "maps/clustering/cluster_tree.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"

namespace cairn::python {
namespace py = pybind11;
namespace {

py::tuple tuple_of(const Pose2& pose) {
  return py::make_tuple(pose.x_m, pose.y_m, pose.theta_rad);
}

// With what only the tree knows of it.
struct LabelledCluster {
  Cluster cluster;
  std::string label;
  std::vector<LandmarkId> landmarks;
};

std::vector<LabelledCluster> clusters_of(const SavedMap& map) {
  std::map<ClusterId, std::vector<LandmarkId>> members;
  for (const auto& [landmark, cluster] : map.clusters.cluster_of)
    for (ClusterId at = cluster; at != 0; at = map.clusters.clusters.at(at).parent) members[at].push_back(landmark);
  std::vector<LabelledCluster> clusters;
  for (const auto& [id, cluster] : map.clusters.clusters)
    clusters.push_back({cluster, label_of(cluster, map.graph), members[id]});
  return clusters;
}

template <class Entries>
py::list values_of(const Entries& entries) {
  py::list values;
  for (const auto& [id, value] : entries) values.append(value);
  return values;
}

void add_landmark(py::module_& module) {
  py::class_<Landmark>(module, "Landmark", "A landmark of a map.")
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
      .def_readonly("degree", &Landmark::degree, "Of its best matching, 0 to 1.")
      .def_readonly("sightings", &Landmark::sightings)
      .def_readonly("level", &Landmark::level)
      .def("__repr__", [](const Landmark& landmark) {
        return "<Landmark " + label_of(landmark) + (landmark.category.empty() ? "" : ", a " + landmark.category) + ">";
      });
}

void add_route(py::module_& module) {
  py::class_<Route>(module, "Route", "A route from a landmark to another; it is directed.")
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

}  // namespace

void add_graph(py::module_& module) {
  add_landmark(module);
  add_route(module);
  py::class_<LabelledCluster>(module, "Cluster", "A cluster of landmarks, of level 1 or above.")
      .def_property_readonly("id", [](const LabelledCluster& it) { return it.cluster.id; })
      .def_property_readonly("level", [](const LabelledCluster& it) { return it.cluster.level; })
      .def_property_readonly(
          "parent", [](const LabelledCluster& it) { return it.cluster.parent; },
          "Id of the cluster one level up; 0: it is on the highest.")
      .def_property_readonly("anchor", [](const LabelledCluster& it) { return it.cluster.anchor; })
      .def_readonly("label", &LabelledCluster::label)
      .def_readonly("landmarks", &LabelledCluster::landmarks, "Ids of the landmarks in it, rising.")
      .def("__repr__", [](const LabelledCluster& it) { return "<Cluster " + it.label + ">"; });
  module.def(
      "landmarks_of", [](const Map& map) { return values_of(map.saved().graph.landmarks()); }, py::arg("map"));
  module.def(
      "routes_of", [](const Map& map) { return values_of(map.saved().graph.routes()); }, py::arg("map"));
  module.def(
      "clusters_of", [](const Map& map) { return clusters_of(map.saved()); }, py::arg("map"));
}

}  // namespace cairn::python
