// Navigation graphs of Open-RMF (`nav_graphs/*.yaml`): what is kept of them in a landmark graph, and writing them. The
// reader, framework/config/rmf_file.hpp, needs the YAML library.
//
//   building_name: office
//   levels: {L1: {vertices: [[x, y, {name: dock, is_charger: true}], ...], lanes: [[0, 1, {speed_limit: 0.5}], ...]}}
//   doors: {...}
//   lifts: {...}
//
// A vertex is a landmark, a lane a directed route, a level a floor, numbered in the order of the file. What has no
// place in the graph is kept as annotations and comes out again: {"rmf": {"level": "L1", "properties": {...}}}, and
// with the whole map, as its property "rmf", the building's name and whatever else stands beside `levels`.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "maps/exchange/graphs/exchanged_graph.hpp"

namespace cairn {

// The property of a vertex that makes a category of a landmark: the first that is true.
struct RmfCategory {
  std::string_view property;
  std::string_view category;
};
inline constexpr std::array<RmfCategory, 3> kRmfCategories{
    {{"is_charger", "charger"}, {"is_parking_spot", "parking_spot"}, {"is_holding_point", "holding_point"}}};

// site: the property "rmf" of the map, or empty. Closed routes and routes between floors are left out, as the warnings
// say. Floors of one name get their number behind it. Throws std::invalid_argument when annotations or site are no JSON
// object.
[[nodiscard]] ExportedGraph rmf_nav_graph_of(const LandmarkGraph& graph, const std::string& site);

}  // namespace cairn
