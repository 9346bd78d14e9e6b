// What a search over a hierarchy is asked and answers, whichever search it is.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "maps/hierarchy/hierarchy.hpp"

namespace cairn {

struct SearchEnd {
  VertexIndex vertex = kNoVertex;
  double cost = 0.0;  // of getting to it first, or on from it; not negative
};

struct RouteQuery {
  std::vector<SearchEnd> from, to;          // any one of each
  std::unordered_set<VertexIndex> avoided;  // not passed; a path may begin or end there
  // Routes that cost something else in this query; kNoRoute: not to be taken.
  std::unordered_map<RouteId, double> costs;
};

struct GraphPath {
  double cost = kNoRoute;                      // kNoRoute: there is none; ends included
  std::vector<VertexIndex> vertices;           // from end to end
  std::vector<RouteId> routes;                 // one less
  bool stopped = false;                        // by the budget, before the answer
  std::int64_t settled = 0;                    // vertices, by all parts of the search
  std::vector<std::int64_t> settled_of_level;  // [0]: vertices looked at one by one
};

// Finds the cheapest path, exactly. Keeps its space for the next search, which then touches what it settles and no
// more. Not thread-safe; belongs to no hierarchy.
class GraphSearch {
 public:
  virtual ~GraphSearch() = default;
  // O(k log k) in the vertices settled. Equal queries give equal paths. budget.iterations: settled vertices.
  [[nodiscard]] virtual GraphPath find(const Hierarchy& hierarchy, const RouteQuery& query, const Budget& budget) = 0;
};

}  // namespace cairn
