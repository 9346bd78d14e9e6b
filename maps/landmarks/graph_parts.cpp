#include "maps/landmarks/graph_parts.hpp"

#include <algorithm>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/strong_components.hpp>
#include <boost/pending/disjoint_sets.hpp>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace cairn {
namespace {

using Graph = boost::compressed_sparse_row_graph<boost::directedS>;
using Ends = std::vector<std::pair<std::size_t, std::size_t>>;
using Marks = std::vector<char>;

Graph graph_of(const Ends& ends, std::size_t vertices) {
  return {boost::edges_are_unsorted_multi_pass, ends.begin(), ends.end(), vertices};
}

Ends open_routes(const LandmarkGraph& graph, const std::vector<LandmarkId>& ids) {
  const auto vertex_of = [&](LandmarkId id) {
    return static_cast<std::size_t>(std::ranges::lower_bound(ids, id) - ids.begin());
  };
  Ends ends;
  ends.reserve(graph.routes().size());
  for (const auto& [id, route] : graph.routes())
    if (!route.closed) ends.emplace_back(vertex_of(route.from), vertex_of(route.to));
  return ends;
}

// Vertices with a route to or from another.
Marks with_route(const Ends& ends, std::size_t vertices) {
  Marks has_route(vertices);
  for (const auto& [from, to] : ends)
    if (from != to) has_route[from] = has_route[to] = 1;
  return has_route;
}

// The vertices of the largest strongly connected component that has routes.
Marks main_part(const Graph& graph, const Marks& has_route) {
  const std::size_t vertices = num_vertices(graph);
  std::vector<std::size_t> component(vertices);
  const std::size_t components = boost::strong_components(
      graph, boost::make_iterator_property_map(component.begin(), get(boost::vertex_index, graph)));
  std::vector<std::size_t> size(components, 0);
  for (const std::size_t one : component) ++size[one];
  std::optional<std::size_t> largest;
  for (std::size_t v = 0; v < vertices; ++v)  // by rising id, so that of equals the first stays
    if (has_route[v] != 0 && (!largest || size[component[v]] > size[*largest])) largest = component[v];
  Marks is_main(vertices);
  for (std::size_t v = 0; v < vertices; ++v) is_main[v] = static_cast<char>(component[v] == largest);
  return is_main;
}

// What can be reached from the marked vertices, themselves included.
Marks reached_from(const Graph& graph, Marks reached) {
  std::vector<std::size_t> open;
  for (std::size_t v = 0; v < reached.size(); ++v)
    if (reached[v] != 0) open.push_back(v);
  while (!open.empty()) {
    const std::size_t from = open.back();
    open.pop_back();
    for (auto [edge, end] = out_edges(from, graph); edge != end; ++edge) {
      const std::size_t to = target(*edge, graph);
      if (std::exchange(reached[to], char{1}) == 0) open.push_back(to);
    }
  }
  return reached;
}

// Of each vertex that is not in the main part.
std::vector<Reach> reach_of_all(const Ends& ends, const Marks& is_main, const Marks& has_route) {
  Ends back = ends;
  for (auto& [from, to] : back) std::swap(from, to);
  const Marks is_reached = reached_from(graph_of(ends, is_main.size()), is_main);
  const Marks leads_to_main = reached_from(graph_of(back, is_main.size()), is_main);
  std::vector<Reach> reach(is_main.size(), Reach::isolated);
  for (std::size_t v = 0; v < reach.size(); ++v) {
    if (has_route[v] == 0) continue;
    reach[v] = is_reached[v] != 0 ? Reach::trap : leads_to_main[v] != 0 ? Reach::no_way_in : Reach::cut_off;
  }
  return reach;
}

}  // namespace

GraphParts parts_of(const LandmarkGraph& graph) {
  GraphParts parts;
  std::vector<LandmarkId> ids;
  ids.reserve(graph.landmarks().size());
  for (const auto& [id, landmark] : graph.landmarks()) ids.push_back(id);
  if (ids.empty()) return parts;
  const Ends ends = open_routes(graph, ids);
  const Marks has_route = with_route(ends, ids.size());
  const Marks is_main = main_part(graph_of(ends, ids.size()), has_route);
  const std::vector<Reach> reach = reach_of_all(ends, is_main, has_route);
  std::vector<std::size_t> rank(ids.size(), 0);
  std::vector<std::size_t> parent(ids.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});  // each alone
  boost::disjoint_sets joined(boost::make_iterator_property_map(rank.begin(), boost::identity_property_map()),
                              boost::make_iterator_property_map(parent.begin(), boost::identity_property_map()));
  for (const auto& [a, b] : ends)
    if (is_main[a] == 0 && is_main[b] == 0 && reach[a] == reach[b]) joined.union_set(a, b);
  std::map<std::size_t, std::size_t> part_of;  // representative -> index in others
  for (std::size_t v = 0; v < ids.size(); ++v) {
    if (is_main[v] != 0) {
      parts.main.push_back(ids[v]);
      continue;
    }
    const auto [part, is_new] = part_of.emplace(joined.find_set(v), parts.others.size());
    if (is_new) parts.others.push_back({reach[v], {}});
    parts.others[part->second].landmarks.push_back(ids[v]);
  }
  return parts;
}

}  // namespace cairn
