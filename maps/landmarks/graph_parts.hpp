// From which landmarks of a graph which others can be reached, over open routes.
#pragma once

#include <vector>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// How a part of the graph hangs together with the main part.
enum class Reach {
  trap,       // reached from the main part, but there is no way back
  no_way_in,  // leads to the main part, but cannot be reached from it
  cut_off,    // neither
  isolated,   // one landmark without any open route
};

struct GraphPart {
  Reach reach = Reach::cut_off;
  std::vector<LandmarkId> landmarks;  // by rising id; joined by routes, whatever their direction
  bool operator==(const GraphPart&) const = default;
};

struct GraphParts {
  // Of the landmarks that have open routes the largest set of which each can be reached from each; of equal
  // ones that with the lowest id. By rising id.
  std::vector<LandmarkId> main;
  std::vector<GraphPart> others;  // everything else, by their lowest ids
};

// Strongly connected components by Boost.Graph, O(n + m) and a search by id for each end of a route.
[[nodiscard]] GraphParts parts_of(const LandmarkGraph& graph);

}  // namespace cairn
