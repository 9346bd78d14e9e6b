#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "maps/base/json_text.hpp"
#include "maps/base/source_text.hpp"
#include "maps/exchange/graphs/file_ids.hpp"
#include "maps/exchange/graphs/losses.hpp"
#include "maps/exchange/graphs/nav2_properties.hpp"
#include "maps/exchange/graphs/nav2_routes.hpp"

namespace cairn {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kMaxNav2Id = 65535;

// What an import has kept, or nothing.
struct Kept {
  bool is_from_nav2 = false;
  Json nav2 = Json::object();
  bool has_more = false;  // members that other formats have kept

  Kept(const std::string& annotations, const std::string& whose) {
    if (annotations.empty()) return;
    if (!exchange::is_json_object(annotations))
      throw std::invalid_argument(whose + ": its annotations are no JSON object");
    const Json all = Json::parse(annotations);
    is_from_nav2 = all.contains("nav2") && all["nav2"].is_object();
    if (is_from_nav2) nav2 = all["nav2"];
    has_more = all.size() > (is_from_nav2 ? 1U : 0U);
  }
  [[nodiscard]] bool was_zero() const { return nav2.contains("id") && nav2["id"] == 0; }
  [[nodiscard]] Json properties() const {
    return nav2.contains("properties") && nav2["properties"].is_object() ? nav2["properties"] : Json::object();
  }
};

std::string feature_text(const Kept& kept, const Json& ids, const Json& properties, const Json& geometry) {
  Json all = ids;
  for (const auto& [key, value] : properties.items())
    if (!all.contains(key)) all[key] = value;
  Json feature{{"type", "Feature"}, {"properties", all}, {"geometry", geometry}};
  if (kept.nav2.contains("feature") && kept.nav2["feature"].is_object())
    for (const auto& [key, value] : kept.nav2["feature"].items())
      if (!feature.contains(key)) feature[key] = value;
  return feature.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Takes the value over where it is not what the properties say already.
template <class Value>
void set_metadata(Json& properties, const char* key, const Value& value) {
  if (!properties.contains("metadata") || !properties["metadata"].is_object()) properties["metadata"] = Json::object();
  properties["metadata"][key] = value;
}

void remove_metadata(Json& properties, const char* key) {
  if (!properties.contains("metadata") || !properties["metadata"].is_object()) return;
  properties["metadata"].erase(key);
  if (properties["metadata"].empty()) properties.erase("metadata");
}

Json point_of(const Pose2& pose) {
  return Json::array({pose.x_m, pose.y_m});
}

class Nav2Writer {
 public:
  explicit Nav2Writer(const LandmarkGraph& graph) : graph_(graph) {}

  ExportedGraph write() {
    std::string& text = exported_.text;
    text =
        "{\n\"type\": \"FeatureCollection\",\n\"name\": \"graph\",\n"
        "\"crs\": {\"type\": \"name\", \"properties\": {\"name\": \"urn:ogc:def:crs:EPSG::3857\"}},\n\"features\": [";
    number_nodes();
    for (const auto& [id, landmark] : graph_.landmarks()) append(node_of(landmark));
    number_edges();
    for (const auto& [id, route] : graph_.routes())
      if (!route.closed) append(edge_of(route));
    text += "\n]\n}\n";
    warn();
    return std::move(exported_);
  }

 private:
  void append(const std::string& feature) {
    exported_.text += is_first_ ? "\n" : ",\n";
    exported_.text += feature;
    is_first_ = false;
  }

  static Kept kept_of(const Landmark& landmark) {
    return {landmark.annotations, "landmark L" + std::to_string(landmark.id)};
  }
  static Kept kept_of(const Route& route) { return {route.annotations, "route " + std::to_string(route.id)}; }

  // A node keeps its id; the one that was 0 is 0 again.
  void number_nodes() {
    for (const auto& [id, landmark] : graph_.landmarks())
      if (zero_ == 0 && !landmark.annotations.empty() && kept_of(landmark).was_zero()) zero_ = id;
  }
  [[nodiscard]] std::int64_t node_id(LandmarkId id) const { return id == zero_ ? 0 : id; }
  [[nodiscard]] bool is_node_id(std::int64_t id) const {
    return id == 0 ? zero_ != 0 : id != zero_ && graph_.find(id) != nullptr;
  }

  void number_edges() {
    if (!graph_.landmarks().empty()) next_ = graph_.landmarks().rbegin()->first + 1;
    if (!graph_.routes().empty()) next_ = std::max(next_, graph_.routes().rbegin()->first + 1);
  }
  std::int64_t edge_id(const Route& route, const Kept& kept) {
    if (kept.was_zero() && !zero_edge_written_ && !is_node_id(0)) {
      zero_edge_written_ = true;
      return 0;
    }
    if (!is_node_id(route.id)) return route.id;
    ++renumbered_;
    // Beyond the last possible id there may be free ones below.
    if (next_ > exchange::kMaxFileId) next_ = 1;
    while (is_node_id(next_) || graph_.find_route(next_) != nullptr) ++next_;
    return next_++;
  }

  std::string node_of(const Landmark& landmark) {
    const Kept kept = kept_of(landmark);
    others_ += kept.has_more;
    Json properties = kept.properties();
    const std::string name = exchange::name_in(properties);
    const bool is_named_by_zero = name.empty() && kept.was_zero() && landmark.name == "0";
    if (landmark.name != name && !is_named_by_zero) {
      remove_metadata(properties, "name");
      properties.erase("name");
      if (!landmark.name.empty()) set_metadata(properties, "name", landmark.name);
    }
    if (landmark.category != exchange::category_in(properties)) {
      remove_metadata(properties, "class");
      if (!landmark.category.empty()) set_metadata(properties, "class", landmark.category);
    }
    Json point = point_of(landmark.T_map_landmark);
    if (kept.nav2.contains("z") && kept.nav2["z"].is_number()) point.push_back(kept.nav2["z"]);
    note_id(node_id(landmark.id));
    return feature_text(kept, {{"id", node_id(landmark.id)}}, properties, {{"type", "Point"}, {"coordinates", point}});
  }

  std::string edge_of(const Route& route) {
    const Kept kept = kept_of(route);
    others_ += kept.has_more;
    Json properties = kept.properties();
    take_cost(route, kept, properties);
    if (route.speed_limit_mps != exchange::speed_limit_in(properties)) {
      remove_metadata(properties, "abs_speed_limit");
      if (route.speed_limit_mps) set_metadata(properties, "abs_speed_limit", *route.speed_limit_mps);
    }
    const std::int64_t id = edge_id(route, kept);
    note_id(id);
    return feature_text(kept, {{"id", id}, {"startid", node_id(route.from)}, {"endid", node_id(route.to)}}, properties,
                        geometry_of(route, kept));
  }

  // A cost that was not set, and still is the straight length, stays not set.
  void take_cost(const Route& route, const Kept& kept, Json& properties) {
    const double straight_m =
        (graph_.find(route.from)->T_map_landmark.position() - graph_.find(route.to)->T_map_landmark.position()).norm();
    const double set_m = exchange::cost_in(properties);
    if (kept.is_from_nav2 && route.cost_m == (set_m > 0.0 ? set_m : straight_m)) return;
    properties["cost"] = route.cost_m;
    free_ += route.cost_m == 0.0;
  }

  [[nodiscard]] Json geometry_of(const Route& route, const Kept& kept) const {
    if (route.trajectory.size() < 2 && kept.nav2.contains("geometry") && kept.nav2["geometry"].is_object())
      return kept.nav2["geometry"];
    Json line = Json::array();
    if (route.trajectory.size() < 2) {
      line.push_back(point_of(graph_.find(route.from)->T_map_landmark));
      line.push_back(point_of(graph_.find(route.to)->T_map_landmark));
    } else {
      for (const Pose2& pose : route.trajectory) line.push_back(point_of(pose));
    }
    return {{"type", "MultiLineString"}, {"coordinates", Json::array({line})}};
  }

  void note_id(std::int64_t id) { too_large_ += id > kMaxNav2Id; }

  void warn() {
    exchange::Holds holds;
    holds.category = holds.annotations = holds.speed_limit = holds.route_ids = true;
    holds.trajectory = true;
    exported_.warnings = exchange::warnings_of_loss(graph_, holds);
    const auto report = [&](std::size_t count, const char* noun, const char* sentence) {
      exchange::warn_of(count, noun, sentence, exported_.warnings);
    };
    report(renumbered_, "edge", "the id is a node's, so it got one above all others: nav2 wants them unique");
    report(too_large_, "feature", "the id is above 65535, which nav2's messages cannot name");
    report(free_, "edge", "cost 0 means \"not set\" to nav2");
    report(others_, "feature", "what other formats keep with it is not written");
    if (graph_.routes().empty()) exported_.warnings.emplace_back("there is no edge: nav2 refuses such a graph");
  }

  const LandmarkGraph& graph_;
  ExportedGraph exported_;
  LandmarkId zero_ = 0;  // the landmark that was node 0
  std::int64_t next_ = 1;
  bool is_first_ = true;
  bool zero_edge_written_ = false;
  std::size_t renumbered_ = 0;
  std::size_t too_large_ = 0;
  std::size_t free_ = 0;
  std::size_t others_ = 0;
};

}  // namespace

ExportedGraph nav2_routes_of(const LandmarkGraph& graph) {
  return Nav2Writer(graph).write();
}

}  // namespace cairn
