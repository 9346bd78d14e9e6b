// Landmarks, routes and clusters as objects with read-only fields.
#include <pybind11/stl.h>

#include "maps/clustering/cluster_tree.hpp"
#include "python/bindings/arrays.hpp"
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

// With the place and time of its anchor, and of its nodes.
struct PlacedSubmap {
  const KeptSubmap* submap = nullptr;
  KeptNode anchor;
  std::vector<KeptNode> nodes;
  std::shared_ptr<SavedMap> map;  // holds the submap
};

std::vector<PlacedSubmap> submaps_of(const std::shared_ptr<SavedMap>& map) {
  std::vector<PlacedSubmap> submaps;
  const KeptSubmaps& kept = map->submaps;
  std::map<std::int64_t, KeptNode> nodes;
  for (const KeptNode& node : kept.nodes) nodes.emplace(node.number, node);
  std::map<std::int64_t, std::vector<KeptNode>> tied;
  for (const KeptEdge& edge : kept.edges)
    if (!edge.is_closure) tied[edge.from].push_back(nodes.at(edge.to));
  submaps.reserve(kept.submaps.size());
  for (const KeptSubmap& submap : kept.submaps) {
    const KeptNode& anchor = nodes.at(submap.anchor);
    std::vector<KeptNode> its{anchor};
    // A later run may have begun near the anchor, and be tied to it.
    for (const KeptNode& node : tied[submap.anchor])
      if (node.number == its.back().number + 1) its.push_back(node);
    submaps.push_back({&submap, anchor, std::move(its), map});
  }
  return submaps;
}

py::array_t<double> stamps_of(const PlacedSubmap& placed) {
  py::array_t<double> stamps(static_cast<py::ssize_t>(placed.nodes.size()));
  std::ranges::transform(placed.nodes, stamps.mutable_data(), &KeptNode::stamp_s);
  return stamps;
}

py::array_t<double> poses_of(const PlacedSubmap& placed) {
  std::vector<Pose2> poses;
  poses.reserve(placed.nodes.size());
  for (const KeptNode& node : placed.nodes) poses.push_back(node.T_map_node);
  return array_of(poses);
}

// A view of the map's own memory.
py::array echoes_of(const py::object& self) {
  const KeptSubmap& submap = *self.cast<const PlacedSubmap&>().submap;
  py::array_t<std::uint8_t> array({submap.height, submap.width}, submap.echoes.data(), self);
  make_read_only(array);
  return array;
}

void add_submap(py::module_& module) {
  py::class_<PlacedSubmap>(module, "Submap", "A piece of the way with what was seen on it, by laser SLAM.")
      .def_property_readonly(
          "pose", [](const PlacedSubmap& it) { return tuple_of(it.anchor.T_map_node); },
          "Of its frame in the map, as last solved: (x m, y m, heading rad).")
      .def_property_readonly(
          "anchor", [](const PlacedSubmap& it) { return it.submap->anchor; }, "Number of the node that is its frame.")
      .def_property_readonly(
          "finished", [](const PlacedSubmap& it) { return it.submap->finished; }, "The robot has left it.")
      .def_property_readonly("cell_m", [](const PlacedSubmap& it) { return it.submap->cell_m; })
      .def_property_readonly(
          "origin_m",
          [](const PlacedSubmap& it) {
            const KeptSubmap& submap = *it.submap;
            return py::make_tuple(submap.cell_m * submap.min_x, submap.cell_m * submap.min_y);
          },
          "Lower left corner of grid[0, 0] in its own frame.")
      .def_property_readonly("grid", &echoes_of,
                             "(rows, columns) uint8: echoes in each cell, 255 means that many or more. A read-only "
                             "view.")
      .def_property_readonly("stamps_s", &stamps_of, "(N,) float64: of its nodes, the anchor first.")
      .def_property_readonly("nodes", &poses_of, "(N, 3) float64: x m, y m, heading rad of its nodes in the map.")
      .def("__repr__", [](const PlacedSubmap& it) {
        return "<Submap of node " + std::to_string(it.submap->anchor) + ", " + std::to_string(it.submap->width) +
               " x " + std::to_string(it.submap->height) + " cells>";
      });
}

}  // namespace

void add_graph(py::module_& module) {
  add_landmark(module);
  add_route(module);
  add_submap(module);
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
      "submaps_of", [](const Map& map) { return submaps_of(map.shared()); }, py::arg("map"));
  module.def(
      "clusters_of", [](const Map& map) { return clusters_of(map.saved()); }, py::arg("map"));
}

}  // namespace cairn::python
