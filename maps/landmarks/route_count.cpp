#include "maps/landmarks/route_count.hpp"

#include <map>
#include <utility>

#include "maps/base/text.hpp"

namespace cairn {

std::string counted_routes(const LandmarkGraph& graph) {
  struct Ways {
    std::size_t up = 0;
    std::size_t down = 0;
  };
  std::map<std::pair<LandmarkId, LandmarkId>, Ways> pairs;
  for (const auto& [id, route] : graph.routes()) {
    Ways& ways = pairs[std::minmax(route.from, route.to)];
    ++(route.from < route.to ? ways.up : ways.down);
  }
  std::size_t both_ways = 0;
  std::size_t one_way = 0;
  for (const auto& [pair, ways] : pairs) {
    if (ways.up > 0 && ways.down > 0)
      ++both_ways;
    else
      one_way += ways.up + ways.down;
  }
  std::string count = counted(graph.routes().size(), "route");
  if (graph.routes().empty()) return count;
  if (both_ways == 0) return count + (one_way == 1 ? " (one way)" : " (all one way)");
  return count + " (" + counted(both_ways, "pair") + " both ways" +
         (one_way > 0 ? ", " + std::to_string(one_way) + " one way)" : ")");
}

}  // namespace cairn
