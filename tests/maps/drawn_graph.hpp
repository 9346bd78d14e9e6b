// Landmark graphs as words: "1<>2 2>3 4" has the landmarks 1 to 4, two routes between 1 and 2, one from 2 to 3.
// Landmark n stands at (n, 0) m.
#pragma once

#include <sstream>
#include <string>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

inline LandmarkId drawn_landmark(LandmarkGraph& graph, const std::string& word) {
  const LandmarkId id = std::stoll(word);
  if (graph.find(id) == nullptr) {
    Landmark landmark;
    landmark.id = id;
    landmark.T_map_landmark = {static_cast<double>(id), 0.0, 0.0};
    graph.add(landmark);
  }
  return id;
}

inline LandmarkGraph drawn_graph(const std::string& text) {
  LandmarkGraph graph;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t arrow = word.find('>');
    if (arrow == std::string::npos) {
      drawn_landmark(graph, word);
      continue;
    }
    const bool both_ways = word[arrow - 1] == '<';
    const Landmark from = *graph.find(drawn_landmark(graph, word.substr(0, arrow - (both_ways ? 1 : 0))));
    const Landmark to = *graph.find(drawn_landmark(graph, word.substr(arrow + 1)));
    Route route;
    route.from = from.id;
    route.to = to.id;
    route.cost_m = (to.T_map_landmark.position() - from.T_map_landmark.position()).norm();
    graph.add_route(route);
    if (!both_ways) continue;
    std::swap(route.from, route.to);
    graph.add_route(route);
  }
  return graph;
}

}  // namespace cairn
