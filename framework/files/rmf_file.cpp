#include "framework/files/rmf_file.hpp"

#include <algorithm>

#include "framework/config/fields.hpp"
#include "framework/files/rmf_site.hpp"
#include "maps/exchange/graphs/file_ids.hpp"
#include "maps/exchange/graphs/rmf_nav_graph.hpp"

namespace cairn {
namespace {

using namespace rmf;

const std::vector<std::string> kNavKeys{"building_name", "levels", "doors", "lifts", "crs_name", "offset"};

Properties properties_of(const ConfigValue& list, const char* what) {
  Properties properties;
  if (list.items.size() < 3) return properties;
  const ConfigValue& map = list.items[2];
  if (map.kind != ConfigValue::Kind::map)
    throw ConfigError(map.place,
                      std::string("the properties of a ") + what + " must be a map, found " + map.kind_name());
  for (const ConfigValue::Entry& entry : map.entries) properties.entries.emplace_back(entry.key, entry.value);
  return properties;
}

// What is kept as it is may still be a slip of the pen.
void warn_of_slips(const ConfigValue& list, const std::vector<std::string>& known, std::vector<std::string>& warnings) {
  if (list.items.size() < 3) return;
  for (const ConfigValue::Entry& entry : list.items[2].entries)
    if (std::ranges::find(known, entry.key) == known.end())
      if (const std::string hint = did_you_mean(entry.key, known); !hint.empty())
        warnings.push_back(entry.key_place.text() + ": the property " + in_quotes(entry.key) + hint +
                           " is kept as it is");
}

Vertex vertex_of(const ConfigValue& value, std::vector<std::string>& warnings) {
  static const std::vector<std::string> kKnown{
      "name",         "lift",  "is_charger", "is_holding_point",    "is_parking_spot",
      "merge_radius", "mutex", "dock_name",  "is_passthrough_point"};
  if (value.kind != ConfigValue::Kind::list || value.items.size() < 2 || value.items.size() > 3)
    throw ConfigError(value.place, "a vertex must be [x, y, {...}], found " + value.kind_name());
  Vertex vertex;
  vertex.at_m = {number(value.items[0], "x"), number(value.items[1], "y")};
  vertex.properties = properties_of(value, "vertex");
  warn_of_slips(value, kKnown, warnings);
  if (const ConfigValue* name = vertex.properties.find("name"); name != nullptr)
    if (name->kind != ConfigValue::Kind::null) vertex.name = name_in(*name, "name");
  vertex.properties.erase("name");
  return vertex;
}

Level level_of(const ConfigValue::Entry& entry, std::vector<std::string>& warnings) {
  static const std::vector<std::string> kKnown{"speed_limit",
                                               "dock_name",
                                               "door_name",
                                               "orientation_constraint",
                                               "mutex",
                                               "is_bidirectional",
                                               "demo_mock_floor_name",
                                               "demo_mock_lift_name",
                                               "undock_name",
                                               "graph_idx"};
  check_keys(entry.value, {"vertices", "lanes"}, "the level " + in_quotes(entry.key), warnings);
  Level level{entry.key, {}, {}};
  for (const ConfigValue& value : list_in(entry.value, "vertices"))
    level.vertices.push_back(vertex_of(value, warnings));
  for (const ConfigValue& value : list_in(entry.value, "lanes")) {
    Lane lane{vertex_index(value, 0, level.vertices.size()), vertex_index(value, 1, level.vertices.size()),
              properties_of(value, "lane")};
    warn_of_slips(value, kKnown, warnings);
    check_orientation(lane.properties, "orientation_constraint");
    const bool is_both = is_true(lane.properties.find("is_bidirectional"));
    if (is_both) lane.properties.erase("is_bidirectional");
    level.lanes.push_back(lane);
    if (!is_both) continue;
    std::swap(lane.from, lane.to);
    level.lanes.push_back(lane);
  }
  return level;
}

Site site_of_nav_graph(const ConfigValue& root) {
  Site site;
  check_keys(root, kNavKeys, "the navigation graph", site.warnings);
  for (const ConfigValue::Entry& entry : root.find("levels")->entries)
    site.levels.push_back(level_of(entry, site.warnings));
  for (const ConfigValue::Entry& entry : root.entries)
    if (entry.key != "levels" && std::ranges::find(kNavKeys, entry.key) != kNavKeys.end())
      site.others.entries.emplace_back(entry.key, entry.value);
  return site;
}

// Only a building has these.
bool is_building(const ConfigValue& root) {
  if (root.find("coordinate_system") != nullptr || root.find("name") != nullptr) return true;
  return std::ranges::any_of(root.find("levels")->entries, [](const ConfigValue::Entry& level) {
    return level.value.find("measurements") != nullptr || level.value.find("walls") != nullptr ||
           level.value.find("drawing") != nullptr || level.value.find("elevation") != nullptr;
  });
}

std::string category_of(const Properties& properties) {
  for (const RmfCategory& of : kRmfCategories)
    if (is_true(properties.find(std::string(of.property)))) return std::string(of.category);
  return "";
}

std::string kept(const Properties& properties, const std::string& more) {
  if (properties.entries.empty() && more.empty()) return "";
  return "{\"rmf\":{" + more +
         (properties.entries.empty() ? ""
                                     : std::string(more.empty() ? "" : ",") + "\"properties\":" + json_of(properties)) +
         "}}";
}

std::optional<double> take_speed_limit(Properties& properties) {
  const ConfigValue* value = properties.find("speed_limit");
  if (value == nullptr) return std::nullopt;
  const double limit = config_detail::to_number(*value, "speed_limit", {0.0, 1e3}, "m/s");
  if (limit == 0.0) return std::nullopt;  // none, and kept as it is
  properties.erase("speed_limit");
  return limit;
}

void add_level(Level& level, int number, LandmarkGraph& graph) {
  ConfigValue name;
  name.kind = ConfigValue::Kind::scalar;
  name.quoted = true;
  name.scalar = level.name;
  std::vector<LandmarkId> ids;
  for (const Vertex& vertex : level.vertices) {
    Landmark landmark;
    landmark.name = vertex.name;
    landmark.category = category_of(vertex.properties);
    landmark.T_map_landmark = {vertex.at_m.x(), vertex.at_m.y(), 0.0};
    landmark.level = number;
    landmark.annotations = kept(vertex.properties, "\"level\":" + json_of(name));
    ids.push_back(graph.add(std::move(landmark)));
  }
  for (Lane& lane : level.lanes) {
    Route route;
    route.from = ids[lane.from];
    route.to = ids[lane.to];
    route.cost_m = (level.vertices[lane.from].at_m - level.vertices[lane.to].at_m).norm();
    route.level = number;
    route.speed_limit_mps = take_speed_limit(lane.properties);
    route.annotations = kept(lane.properties, "");
    graph.add_route(std::move(route));
  }
}

}  // namespace

bool is_rmf(const ConfigValue& root) {
  if (root.find("levels") != nullptr) return true;
  if (root.find("image") == nullptr)
    for (const ConfigValue::Entry& entry : root.entries)
      if (const std::string hint = did_you_mean(entry.key, {"levels"}); !hint.empty())
        throw ConfigError(entry.key_place, "unknown key " + in_quotes(entry.key) + hint);
  return false;
}

ImportedGraph rmf_graph_of(const ConfigValue& root) {
  const ConfigValue& levels = *root.find("levels");
  if (levels.kind != ConfigValue::Kind::map)
    throw ConfigError(levels.place, "levels must be a map {name: {vertices, lanes}}, found " + levels.kind_name());
  Site site = is_building(root) ? site_of_building(root) : site_of_nav_graph(root);
  ImportedGraph imported;
  int number = 0;
  for (Level& level : site.levels) add_level(level, number++, imported.graph);
  if (imported.graph.landmarks().empty()) throw ConfigError(levels.place, "the levels hold no vertex");
  imported.warnings = std::move(site.warnings);
  exchange::warn_of_shared_names(imported.graph, imported.warnings);
  imported.properties["rmf"] = json_of(site.others);
  return imported;
}

}  // namespace cairn
