// What searches over a landmark graph must find, by plain means.
#pragma once

#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "planners/landmark_search/graph_search.hpp"

namespace cairn::test {

// A RouteQuery in the words of the graph.
struct Question {
  std::map<LandmarkId, double> from, to;
  std::set<LandmarkId> avoided;
  std::map<RouteId, double> costs;
};
[[nodiscard]] RouteQuery query_of(const Question& question, const Network& network);

// What varies in a random question besides its ends.
struct Variety {
  int max_ends = 1;  // on each side
  bool end_costs = false;
  int max_avoided = 0;  // ends among them
  int max_costs = 0;    // of routes, also closed and opened ones
};
[[nodiscard]] Question random_question(const LandmarkGraph& graph, const Variety& variety, std::mt19937_64& random);

// The cost of the cheapest answer, by Dijkstra; kNoRoute: there is none.
[[nodiscard]] double cheapest(const LandmarkGraph& graph, const Question& question);
// The costs of all answers that pass no landmark twice, rising, by trying each.
[[nodiscard]] std::vector<double> all_costs(const LandmarkGraph& graph, const Question& question);
// What is wrong with an answer apart from its being the cheapest: ends, joints, avoided landmarks, landmarks passed
// twice, a cost that is not the sum; or nothing. A path that is not there is not wrong.
[[nodiscard]] std::string fault_of(const GraphPath& path, const Question& question, const LandmarkGraph& graph,
                                   const Network& network);
[[nodiscard]] bool same_cost(double a, double b);

}  // namespace cairn::test
