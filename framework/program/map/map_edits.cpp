#include "framework/program/map/map_edits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "framework/config/config_value.hpp"
#include "framework/files/template_file.hpp"
#include "framework/planning/landmark_names.hpp"
#include "framework/planning/place.hpp"
#include "framework/program/common/refusal.hpp"
#include "maps/base/output_file.hpp"
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

Point place_in(const SavedMap& map, const std::string& text) {
  const Place place = parse_place(text, map.graph);
  if (place.pose) return place.pose->position();
  if (place.landmarks.size() != 1)
    throw std::runtime_error(fmt::format("template capture: --at \"{}\" is {} landmarks; name one, such as L{}", text,
                                         place.landmarks.size(), place.landmarks.front()));
  return map.graph.find(place.landmarks.front())->T_map_landmark.position();
}

// Leaves no file behind that would not load.
LandmarkShape write_template(const std::filesystem::path& file, const std::string& text) {
  if (std::filesystem::exists(std::filesystem::symlink_status(file)))
    throw std::runtime_error(file.string() + ": there is such a file already");
  write_file(file, text);
  try {
    return load_landmark_shape(file);
  } catch (...) {
    std::filesystem::remove(file);
    throw;
  }
}

}  // namespace

std::string name_in_map(const std::filesystem::path& map, const std::string& what, const std::string& name) {
  SavedMap changed = load_map(map);
  std::string id = give_name(changed, what, name);
  save_map(map, changed);
  return id;
}

std::vector<RouteId> set_closed_in_map(const CloseCommand& command, bool closed) {
  SavedMap map = load_map(command.map);
  std::vector<RouteId> ids = routes_of(command, map.graph);
  std::erase_if(ids, [&](RouteId id) { return map.graph.find_route(id)->closed == closed; });
  for (const RouteId id : ids) map.graph.set_closed(id, closed);
  if (!ids.empty()) save_map(command.map, map);
  return ids;
}

CapturedTemplate capture_template(const CaptureCommand& command) {
  const SavedMap map = load_map(command.map);
  const CapturedOutline captured = refused_about(
      command.map.string(), [&] { return captured_outline(map.grid, place_in(map, command.at), command.radius_m); });
  return {write_template(command.out, template_text(command.category, captured, command.map.filename().string())),
          captured.at_m};
}

}  // namespace cairn
