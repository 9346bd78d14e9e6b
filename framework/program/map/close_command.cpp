#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/planning/place.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {
namespace {

std::vector<RouteId> routes_of(const CloseCommand& command, const LandmarkGraph& graph) {
  std::vector<RouteId> ids;
  for (const std::string& text : command.routes) ids.push_back(parse_route(text, graph));
  const std::size_t named = ids.size();
  for (std::size_t i = 0; command.both_ways && i < named; ++i) {
    const Route& there = *graph.find_route(ids[i]);
    for (const auto& [id, route] : graph.routes())
      if (route.from == there.to && route.to == there.from) ids.push_back(id);
  }
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

int set_closed(const CloseCommand& command, bool closed, const CommonOptions& common) {
  SavedMap map = load_map(command.map);
  std::string changed;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const RouteId id : routes_of(command, map.graph)) {
    if (map.graph.find_route(id)->closed == closed) continue;
    map.graph.set_closed(id, closed);
    changed += (changed.empty() ? "R" : ", R") + std::to_string(id);
    list.push_back(id);
  }
  if (!list.empty()) save_map(command.map, map);
  const char* now = closed ? "closed" : "open";
  print_report({{"map", command.map.string()}, {"changed", list}, {"closed", closed}},
               list.empty() ? std::string("nothing to do: already ") + now
                            : counted(list.size(), "route") + " " + now + ": " + changed,
               {}, common);
  return kExitDone;
}

}  // namespace

int map_close(const CloseCommand& command, const CommonOptions& common) {
  return set_closed(command, true, common);
}

int map_open(const CloseCommand& command, const CommonOptions& common) {
  return set_closed(command, false, common);
}

}  // namespace cairn
