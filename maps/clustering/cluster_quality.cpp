#include "maps/clustering/cluster_quality.hpp"

#include <algorithm>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>

namespace cairn {
namespace {

struct Edge {
  double cost = 0.0;
};
using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, Edge>;

std::vector<std::vector<VertexIndex>> landmarks_of_level(const Network& network, const Clustering& clustering,
                                                         int level) {
  std::vector<std::vector<VertexIndex>> landmarks(clustering.end());
  for (VertexIndex v = 0; v < network.end(); ++v)
    if (const ClusterIndex c = clustering.cluster_of(v, level); c != kNoCluster) landmarks[c].push_back(v);
  std::erase_if(landmarks, [](const auto& some) { return some.empty(); });
  return landmarks;
}

// The open routes among some landmarks, which are rising.
Graph graph_among(const std::vector<VertexIndex>& landmarks, const Network& network) {
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < landmarks.size(); ++i)
    for (const Arc& arc : network.out(landmarks[i])) {
      const auto at = std::lower_bound(landmarks.begin(), landmarks.end(), arc.other);
      if (at == landmarks.end() || *at != arc.other || !(arc.cost < kNoRoute)) continue;
      ends.emplace_back(i, static_cast<std::size_t>(at - landmarks.begin()));
      edges.push_back({arc.cost});
    }
  return {boost::edges_are_unsorted_multi_pass, ends.begin(), ends.end(), edges.begin(), landmarks.size()};
}

double diameter_of(const Graph& graph) {
  const std::size_t vertices = num_vertices(graph);
  std::vector<double> cost(vertices);
  double longest = 0.0;
  for (std::size_t from = 0; from < vertices; ++from) {
    boost::dijkstra_shortest_paths(
        graph, from,
        boost::weight_map(boost::get(&Edge::cost, graph))
            .distance_inf(kNoRoute)
            .distance_map(boost::make_iterator_property_map(cost.begin(), boost::get(boost::vertex_index, graph))));
    for (const double reached : cost)
      if (reached < kNoRoute) longest = std::max(longest, reached);
  }
  return longest;
}

std::size_t routes_cut(const Network& network, const Clustering& clustering, int level) {
  std::size_t cut = 0;
  for (VertexIndex v = 0; v < network.end(); ++v) {
    const ClusterIndex here = clustering.cluster_of(v, level);
    const auto& arcs = network.out(v);
    cut += static_cast<std::size_t>(std::count_if(
        arcs.begin(), arcs.end(), [&](const Arc& arc) { return clustering.cluster_of(arc.other, level) != here; }));
  }
  return cut;
}

}  // namespace

std::vector<LevelQuality> cluster_quality(const Network& network, const Clustering& clustering,
                                          std::int32_t max_for_diameter) {
  std::vector<LevelQuality> levels;
  for (int level = 1; level <= clustering.levels(); ++level) {
    LevelQuality quality;
    quality.level = level;
    quality.routes_cut = routes_cut(network, clustering, level);
    for (const ClusterIndex c : clustering.of_level(level)) {
      const ClusterNode& node = clustering.node(c);
      ++quality.clusters;
      quality.boundary += node.boundary.size();
      quality.largest = std::max(quality.largest, node.landmarks);
    }
    const auto clusters = static_cast<double>(quality.clusters);
    quality.mean = static_cast<double>(network.landmarks()) / clusters;
    if (quality.largest <= max_for_diameter) {
      double sum = 0.0;
      for (const auto& landmarks : landmarks_of_level(network, clustering, level))
        sum += diameter_of(graph_among(landmarks, network));
      quality.diameter = sum / clusters;
    }
    levels.push_back(quality);
  }
  return levels;
}

}  // namespace cairn
