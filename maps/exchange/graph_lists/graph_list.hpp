// The plain list of a landmark graph, `.graph`: what road networks and scripts write.
//
//   node ID X_M Y_M [NAME]     NAME is the rest of the line
//   edge FROM TO COST_M        directed
//   # a comment, also behind an edge's cost or a node's Y_M
//
// Node 17 becomes landmark L17, edges become routes 1, 2, ... in their order. Ids are whole numbers of 0 to 2^53 - 1;
// node 0 gets the next free id, and the name "0" when it has none. Edges may stand before their nodes. Line ends may be
// CRLF. A last line without line end is accepted with a warning.
#pragma once

#include <string>
#include <string_view>

#include "maps/exchange/graphs/exchanged_graph.hpp"

namespace cairn {

// Linear but for sorting the ids. Throws ExchangeError with file:line:column on anything else than the above: unknown
// words, missing or further tokens, numbers that are not finite, negative costs, ids that are there twice or not at
// all, names with control characters, no node.
[[nodiscard]] ImportedGraph parse_graph_list(std::string_view text, const std::string& file_name);
// Reads back as the same landmarks (id, position, name) and routes (ends, cost), to the last bit. Closed routes and
// names that a line cannot hold are left out, as the warnings say.
[[nodiscard]] ExportedGraph graph_list_of(const LandmarkGraph& graph);

}  // namespace cairn
