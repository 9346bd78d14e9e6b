// nav2's route graph as GeoJSON (nav2_route, its file loader and saver).
//
// A Point feature is a landmark, a LineString or MultiLineString feature a directed route. What the graph has a place
// for goes there: id, coordinates, metadata.name (or properties.name), metadata.class (the category), cost,
// metadata.abs_speed_limit. Everything else of a feature's properties is kept as annotations,
//   {"nav2": {"id": 0, "z": 1.5, "properties": {"frame": ..., "metadata": ..., "operations": ...}}},
// and comes out again as it went in: "id" only where the graph gave another, "z" the third coordinate of a node.
//
// Rules. Node 0 gets the next free id and the name "0" when it has none; it is written as 0 again. An edge 0, or with
// an id that an earlier edge has, gets the next free id. A cost that is absent or 0 is "not set" to nav2: the route
// costs its straight length, and the file gets back what it had. Geometry of edges is not the path, as in nav2: a line
// of more than two points is kept ("geometry") and written again, but the route has no trajectory from it.
// Coordinates are metres in the map frame, whatever crs says (a warning unless it is EPSG:3857); geographic ones are
// refused.
#pragma once

#include <string>
#include <string_view>

#include "maps/exchange/graphs/exchanged_graph.hpp"

namespace cairn {

// Throws ExchangeError with file:line:column: what is not JSON, nests deeper than 64 brackets or has a key twice; a
// feature that is not a node and no edge, ids that are no whole numbers of 0 to 2^53 - 1, node ids that are there
// twice, ends that are no node, negative costs, coordinates that are no 2 or 3 numbers, operations that nav2 does not
// know.
[[nodiscard]] ImportedGraph parse_nav2_routes(std::string_view text, const std::string& file_name);
// Ids are unique across nodes and edges: an edge whose id a node has gets one above all others. Edges have real
// coordinates: the trajectory, else the kept geometry, else the two ends. Throws std::invalid_argument when annotations
// are no JSON object.
[[nodiscard]] ExportedGraph nav2_routes_of(const LandmarkGraph& graph);

}  // namespace cairn
