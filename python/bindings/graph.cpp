// Landmarks, routes and clusters as objects with read-only fields.
#include <pybind11/stl.h>

#include "maps/clustering/cluster_tree.hpp"
#include "python/bindings/bindings.hpp"
#include "python/shared/graph_classes.hpp"

namespace cairn::python {
namespace py = pybind11;
namespace {

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
