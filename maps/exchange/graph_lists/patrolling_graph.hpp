// Graphs of the ROS package patrolling_sim, `.graph`: vertices on the pixels of a map_server picture.
//
//   N WIDTH_PX HEIGHT_PX RESOLUTION_M OFFSET_X_M OFFSET_Y_M
//   then, N times:       ID X_PX Y_PX DEGREE
//   and DEGREE times:    NEIGHBOUR DIRECTION COST_PX
//
// Line ends are blanks. A vertex becomes the landmark of its id (0: the next free id, named "0"), each neighbour a
// one-way route. Pixels become metres by resolution and offset, y counted from the picture's lower edge.
#pragma once

#include <string>
#include <string_view>

#include "maps/exchange/graphs/exchanged_graph.hpp"

namespace cairn {

// Whether a `.graph` text begins as one of patrolling_sim, with a number.
[[nodiscard]] bool is_patrolling_graph(std::string_view text);

// Throws ExchangeError with file:line:column on missing, further or impossible values, ids that are there twice, and
// neighbours that are not there.
[[nodiscard]] ImportedGraph parse_patrolling_graph(std::string_view text, const std::string& file_name);

}  // namespace cairn
