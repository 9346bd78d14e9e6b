// Places as people write them: `x,y`, `x,y,angle_deg`, `L12`, a landmark's name, `C1:L12`, a cluster's name,
// `tag 7` (a printed marker), `nearest CATEGORY`.
#pragma once

#include <stdexcept>
#include <string>

#include "framework/contracts/planner.hpp"
#include "maps/clustering/cluster_tree.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// what(): what was found and what is allowed, with the nearest known name.
class PlaceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The text is wrong on any map: what is not a place of any kind, or no route's number.
class MalformedPlace : public PlaceError {
 public:
  using PlaceError::PlaceError;
};

// Whether the text is a place without any landmark's help, a sound one or not: numbers with commas, "nearest ...".
[[nodiscard]] bool reads_as_place(const std::string& text);

// Throws MalformedPlace, and PlaceError when the map does not hold what is named.
// A cluster is any of its landmarks: a planner goes to the one that is the cheapest to reach.
[[nodiscard]] Place parse_place(const std::string& text, const LandmarkGraph& graph, const ClusterTree& clusters = {});
// A route by its number, "12" or "R12". Throws the same.
[[nodiscard]] RouteId parse_route(const std::string& text, const LandmarkGraph& graph);

}  // namespace cairn
