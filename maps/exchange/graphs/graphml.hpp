// Landmark graphs as GraphML, as networkx, igraph, Gephi and yEd write and read it.
//
// A node's keys: x and y in metres (needed; or x_m, y_m; else the place that yEd drew it at), theta_rad, level (floor),
// name or label, category or class, april_tag (a printed marker, "tag 7"). An edge's: cost_m, cost, weight, length or
// distance, the first of these that is there (none: the straight length), closed, driven, level, speed_limit_mps. The
// key annotations is the text of a JSON object; every other key becomes a member of the annotations.
//
// When all node ids are the same letters before a number, each number once ("n17", "17"), that is the landmark's id
// (0: the next free one, and the id as its name when it has none). Otherwise landmarks are numbered in the order of
// the file, and the id is the name. Edge ids likewise. An undirected edge is two routes.
#pragma once

#include <string>
#include <string_view>

#include "maps/exchange/graphs/exchanged_graph.hpp"

namespace cairn {

// UTF-8 only. Throws ExchangeError with file:line:column: what is not XML or no GraphML, unknown elements and keys, ids
// that are missing or there twice, ends that are no node, nodes without place, numbers that are not finite, negative
// costs, graphs in nodes, hyperedges, a second graph, a crs in degrees.
[[nodiscard]] ImportedGraph parse_graphml(std::string_view text, const std::string& file_name);
// Reads back as the same, but for what the warnings say. The cost's key is "weight", which other tools know.
[[nodiscard]] ExportedGraph graphml_of(const LandmarkGraph& graph);

}  // namespace cairn
