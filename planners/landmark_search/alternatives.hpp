// The next cheapest paths, none of which passes a landmark twice (Yen, Finding the k shortest loopless paths, 1971).
#pragma once

#include <vector>

#include "planners/landmark_search/graph_search.hpp"

namespace cairn {

// Up to `count` paths after `best`, which answers the query, by rising cost; fewer when there are no more or the
// budget ends. Paths that take another of several parallel routes count as others. One search a landmark of each path.
[[nodiscard]] std::vector<GraphPath> alternatives_to(const GraphPath& best, int count, const Hierarchy& hierarchy,
                                                     const RouteQuery& query, GraphSearch& search,
                                                     const Budget& budget);

}  // namespace cairn
