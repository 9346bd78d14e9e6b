#include "maps/exchange/graphs/rmf_nav_graph.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "maps/base/json_text.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/yaml_text.hpp"
#include "maps/exchange/graphs/losses.hpp"

namespace cairn {
namespace {

using Json = nlohmann::ordered_json;

Json object_of(const std::string& text, const std::string& whose) {
  if (text.empty()) return Json::object();
  if (!exchange::is_json_object(text)) throw std::invalid_argument(whose + " is not a JSON object");
  return Json::parse(text);
}

// In one line, as YAML's flow style.
std::string yaml_of(const Json& value) {
  if (value.is_string()) return exchange::yaml_text(value.get<std::string>());
  if (value.is_number_float()) return exchange::yaml_number(value.get<double>());
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [key, item] : value.items()) {
    if (!text.empty()) text += ", ";
    if (value.is_object()) text += exchange::yaml_flow_key(key) + " ";
    text += yaml_of(item);
  }
  return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

class RmfWriter {
 public:
  RmfWriter(const LandmarkGraph& graph, const std::string& site)
      : graph_(graph), site_(object_of(site, "what the map keeps of Open-RMF")) {}

  ExportedGraph write() {
    for (const auto& [id, landmark] : graph_.landmarks()) add(landmark);
    for (const auto& [id, route] : graph_.routes()) add(route);
    std::string& text = exported_.text;
    const auto name = site_.find("building_name");
    text = "building_name: " + (name != site_.end() ? yaml_of(*name) : std::string("building")) + "\nlevels:\n";
    std::set<std::string> names;
    for (const auto& [number, level] : levels_) {
      std::string level_name = name_of(number, level);
      while (!names.insert(level_name).second) level_name += "_" + std::to_string(number);
      text += exchange::yaml_block_key(level_name, "  ") + "\n";
      text += level.lanes.empty() ? "    lanes: []\n" : "    lanes:\n" + level.lanes;
      text += "    vertices:\n" + level.vertices;
    }
    for (const char* key : {"doors", "lifts"})
      if (!site_.contains(key)) site_[key] = Json::object();
    for (const auto& [key, value] : site_.items())
      if (key != "building_name" && key != "levels")
        text += exchange::yaml_block_key(key) + " " + yaml_of(value) + "\n";
    warn();
    return std::move(exported_);
  }

 private:
  struct Level {
    std::string name;
    std::string vertices;
    std::string lanes;
    std::size_t count = 0;
  };

  static std::string name_of(int number, const Level& level) {
    return level.name.empty() ? "L" + std::to_string(number + 1) : level.name;
  }

  Json kept_of(const std::string& annotations, const std::string& whose) {
    const Json all = object_of(annotations, whose + ": its annotations");
    const bool has_rmf = all.contains("rmf") && all["rmf"].is_object();
    others_ += all.size() > (has_rmf ? 1U : 0U);
    return has_rmf ? all["rmf"] : Json::object();
  }
  static Json properties_of(const Json& kept) {
    return kept.contains("properties") && kept["properties"].is_object() ? kept["properties"] : Json::object();
  }

  void add(const Landmark& landmark) {
    const Json kept = kept_of(landmark.annotations, "landmark L" + std::to_string(landmark.id));
    Level& level = levels_[landmark.level];
    if (level.name.empty() && kept.contains("level") && kept["level"].is_string()) level.name = kept["level"];
    Json properties{{"name", landmark.name}};
    properties.update(properties_of(kept));
    take_category(landmark.category, properties);
    level.vertices += "      - [" + exchange::yaml_number(landmark.T_map_landmark.x_m) + ", " +
                      exchange::yaml_number(landmark.T_map_landmark.y_m) + ", " + yaml_of(properties) + "]\n";
    index_of_[landmark.id] = level.count++;
  }

  // A category that the properties do not say already.
  void take_category(const std::string& category, Json& properties) {
    const auto is_set = [&](const RmfCategory& of) {
      const auto found = properties.find(std::string(of.property));
      return found != properties.end() && found->is_boolean() && found->get<bool>();
    };
    const auto said = std::ranges::find_if(kRmfCategories, is_set);
    if (category == (said == kRmfCategories.end() ? std::string_view() : said->category)) return;
    const auto wanted = std::ranges::find(kRmfCategories, std::string_view(category), &RmfCategory::category);
    if (wanted == kRmfCategories.end()) {
      categories_lost_ += !category.empty();
      return;
    }
    for (const RmfCategory* of = kRmfCategories.begin(); of != wanted; ++of)
      properties.erase(std::string(of->property));
    properties[std::string(wanted->property)] = true;
  }

  void add(const Route& route) {
    if (route.closed) return;
    const Landmark& from = *graph_.find(route.from);
    if (from.level != graph_.find(route.to)->level) {
      ++between_floors_;
      return;
    }
    Json properties = properties_of(kept_of(route.annotations, "route " + std::to_string(route.id)));
    if (route.speed_limit_mps) properties["speed_limit"] = *route.speed_limit_mps;
    const double straight_m =
        (from.T_map_landmark.position() - graph_.find(route.to)->T_map_landmark.position()).norm();
    costs_lost_ += std::abs(route.cost_m - straight_m) > 1e-9 * (1.0 + straight_m);
    levels_[from.level].lanes += "      - [" + std::to_string(index_of_[route.from]) + ", " +
                                 std::to_string(index_of_[route.to]) + ", " + yaml_of(properties) + "]\n";
  }

  void warn() {
    exchange::Holds holds;
    holds.category = holds.level = holds.annotations = holds.speed_limit = true;
    exported_.warnings = exchange::warnings_of_loss(graph_, holds);
    const auto report = [&](std::size_t count, const char* noun, const char* sentence) {
      exchange::warn_of(count, noun, sentence, exported_.warnings);
    };
    report(categories_lost_, "landmark", "the category is not written");
    report(costs_lost_, "route", "the cost is not written; to Open-RMF a lane is straight");
    report(between_floors_, "route", "it leads to another floor, and so is left out: lanes stay on theirs");
    report(others_, "landmark or route", "what other formats keep with it is not written");
  }

  const LandmarkGraph& graph_;
  Json site_;
  ExportedGraph exported_;
  std::map<int, Level> levels_;
  std::map<LandmarkId, std::size_t> index_of_;  // on its level
  std::size_t categories_lost_ = 0;
  std::size_t costs_lost_ = 0;
  std::size_t between_floors_ = 0;
  std::size_t others_ = 0;
};

}  // namespace

ExportedGraph rmf_nav_graph_of(const LandmarkGraph& graph, const std::string& site) {
  return RmfWriter(graph, site).write();
}

}  // namespace cairn
