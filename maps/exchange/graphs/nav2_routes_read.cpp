#include <algorithm>
#include <nlohmann/json.hpp>

#include "maps/base/json_text.hpp"
#include "maps/base/spelling.hpp"
#include "maps/exchange/graphs/crs.hpp"
#include "maps/exchange/graphs/file_ids.hpp"
#include "maps/exchange/graphs/nav2_properties.hpp"
#include "maps/exchange/graphs/nav2_routes.hpp"

namespace cairn {
namespace {

using exchange::SourceText;
using Json = nlohmann::ordered_json;
using Path = std::vector<std::string>;

Json json_in(const SourceText& source, std::size_t begin, std::size_t end) {
  try {
    return Json::parse(source.text().substr(begin, end - begin));
  } catch (const nlohmann::json::parse_error& error) {
    const std::string what = error.what();
    const std::size_t tail = what.find(": ", what.find("column"));
    const std::string reason = tail == std::string::npos ? what : what.substr(tail + 2);
    source.fail(begin + (error.byte == 0 ? 0 : error.byte - 1), "is not JSON: " + reason);
  } catch (const nlohmann::json::exception& error) {  // a number that no double holds
    const std::string what = error.what();
    source.fail(begin, "is not accepted: " + what.substr(std::min(what.size(), what.find("] ") + 2)));
  }
}

// One feature, and errors that point into it.
class Feature {
 public:
  Feature(const SourceText& source, exchange::JsonSlice slice)
      : source_(source), begin_(slice.begin), json_(json_in(source, slice.begin, slice.end)) {
    if (!json_.is_object()) fail({}, std::string("a feature must be an object, is ") + json_.type_name());
    if (json_.value("type", Json()) != "Feature") fail({"type"}, "the type of a feature must be \"Feature\"");
    for (const char* part : {"properties", "geometry"})
      if (!json_.contains(part) || !json_[part].is_object())
        fail({part}, std::string("a feature needs ") + part + ", an object");
  }

  [[noreturn]] void fail(const Path& path, const std::string& sentence) const {
    source_.fail(exchange::offset_of(source_, begin_, path), sentence);
  }
  [[nodiscard]] std::size_t offset() const { return begin_; }
  Json& json() { return json_; }
  Json& properties() { return json_["properties"]; }
  [[nodiscard]] const Json& geometry() const { return json_.at("geometry"); }

  std::int64_t take_id(const char* key) {
    Json& all = properties();
    const auto found = all.find(key);
    if (found == all.end()) fail({"properties"}, std::string("the feature has no ") + key);
    if (!found->is_number_unsigned() || found->get<std::uint64_t>() > exchange::kMaxFileId)
      fail({"properties", key}, std::string(key) + " " + found->dump() + " is not a whole number of 0 to " +
                                    std::to_string(exchange::kMaxFileId));
    const auto id = found->get<std::int64_t>();
    all.erase(key);
    return id;
  }

  // Every value of these keys that is there has the right type.
  void check_properties() {
    check("frame", &Json::is_string, "a text");
    check("metadata", &Json::is_object, "an object");
    check("overridable", &Json::is_boolean, "true or false");
    check("cost", &Json::is_number, "a number");
    if (exchange::cost_in(properties()) < 0.0)
      fail({"properties", "cost"}, "cost " + properties()["cost"].dump() + " is not allowed: it must not be negative");
    const Json* limit = exchange::metadata_in(properties(), "abs_speed_limit");
    if (limit != nullptr && (!limit->is_number() || limit->get<double>() < 0.0))
      fail({"properties", "metadata", "abs_speed_limit"},
           "abs_speed_limit " + limit->dump() + " is not a speed in m/s: it must be a number that is not negative");
    if (!properties().contains("operations")) return;
    if (const auto fault = exchange::fault_of_operations(properties()["operations"])) {
      Path path{"properties", "operations"};
      path.insert(path.end(), fault->path.begin(), fault->path.end());
      fail(path, fault->sentence);
    }
  }

 private:
  void check(const char* key, bool (Json::*is_right)() const noexcept, const char* allowed) {
    const auto found = properties().find(key);
    if (found != properties().end() && !((*found).*is_right)())
      fail({"properties", key}, std::string(key) + " must be " + allowed + ", is " + found->type_name());
  }

  const SourceText& source_;
  std::size_t begin_;
  Json json_;
};

struct Nav2Node {
  std::int64_t id = 0;
  std::size_t offset = 0;
  Landmark landmark;
};

struct Nav2Edge {
  std::int64_t from = 0;
  std::int64_t to = 0;
  std::size_t offset = 0;  // of the feature
  Route route;             // costs 0 as long as none is set
};

// How often each rule was needed.
struct Counts {
  std::size_t heights = 0;
  std::size_t other_frames = 0;
  std::size_t singular_operations = 0;
  std::size_t bent_lines = 0;
  std::size_t unset_costs = 0;
  std::size_t not_overridable_unset = 0;
};

class Nav2Reader {
 public:
  explicit Nav2Reader(const SourceText& source) : source_(source) {}

  ImportedGraph read() {
    exchange::JsonSlice features;
    std::size_t end = 0;
    for (const exchange::JsonMember& member : exchange::members_at(source_, 0, end)) take_member(member, features);
    if (const std::size_t more = exchange::skip_blanks(source_, end); more < source_.text().size())
      source_.fail(more, "nothing may follow the closing bracket");
    if (!is_collection_) source_.fail(0, "is not a FeatureCollection: \"type\": \"FeatureCollection\" is missing");
    if (features.end == 0) source_.fail(0, "has no \"features\"");
    for (const exchange::JsonSlice& slice : exchange::items_at(source_, features.begin)) take_feature(slice);
    if (nodes_.empty()) source_.fail(features.begin, "holds no node (a Point feature)");
    return graph();
  }

 private:
  void take_member(const exchange::JsonMember& member, exchange::JsonSlice& features) {
    if (member.key == "features") {
      features = {member.begin, member.end};
      return;
    }
    const Json value = json_in(source_, member.begin, member.end);
    if (member.key == "type") {
      if (value != "FeatureCollection")
        source_.fail(member.begin, "type must be \"FeatureCollection\", is " + in_quotes(value.dump()));
      is_collection_ = true;
    }
    if (member.key == "crs") take_crs(value, member);
  }

  void take_crs(const Json& crs, const exchange::JsonMember& member) {
    if (crs.is_null()) return;
    if (!crs.is_object()) source_.fail(member.begin, std::string("crs must be an object, is ") + crs.type_name());
    const Json properties = crs.value("properties", Json());
    const Json name = properties.is_object() ? properties.value("name", Json()) : Json();
    crs_ = name.is_string() ? name.get<std::string>() : "a crs without name";
    if (exchange::is_geographic_crs(crs_))
      source_.fail(
          exchange::offset_of(source_, member.begin, {"properties", "name"}),
          "crs " + in_quotes(crs_) + " has degrees of longitude and latitude; a map needs metres in its own frame");
  }

  void take_feature(const exchange::JsonSlice& slice) {
    Feature feature(source_, slice);
    const Json type = feature.geometry().value("type", Json());
    if (type == "Point") {
      take_node(feature);
    } else if (type == "LineString" || type == "MultiLineString") {
      take_edge(feature);
    } else {
      feature.fail({"geometry", "type"}, "geometry of type " +
                                             in_quotes(type.is_string() ? type.get<std::string>() : type.dump()) +
                                             ": allowed are Point (a node), LineString and MultiLineString (an edge)");
    }
  }

  static void check_point(const Feature& feature, const Json& point, const Path& path) {
    const auto is_number = [](const Json& part) { return part.is_number(); };
    if (!point.is_array() || point.size() < 2 || point.size() > 3 || !std::ranges::all_of(point, is_number))
      feature.fail(path,
                   "a point must be 2 or 3 numbers, [x_m, y_m] or [x_m, y_m, z_m], is " + in_quotes(point.dump()));
  }

  void take_node(Feature& feature) {
    feature.check_properties();
    Nav2Node node;
    node.id = feature.take_id("id");
    node.offset = exchange::offset_of(source_, feature.offset(), {"properties", "id"});
    const Json point = feature.geometry().value("coordinates", Json());
    check_point(feature, point, {"geometry", "coordinates"});
    const std::size_t at = exchange::offset_of(source_, feature.offset(), {"geometry", "coordinates"});
    for (int i : {0, 1}) source_.check_coordinate(at, point[i].get<double>());
    node.landmark.T_map_landmark = {point[0].get<double>(), point[1].get<double>(), 0.0};
    node.landmark.name = exchange::name_in(feature.properties());
    node.landmark.category = exchange::category_in(feature.properties());
    exchange::check_names(source_, feature.offset(), feature.properties(), node.landmark);
    if (node.id == 0 && node.landmark.name.empty()) node.landmark.name = "0";
    Json kept = kept_of(feature, node.id);
    if (point.size() == 3) kept["z"] = point[2];
    counts_.heights += point.size() == 3;
    if (!kept.empty()) node.landmark.annotations = Json{{"nav2", kept}}.dump();
    nodes_.push_back(std::move(node));
  }

  void take_edge(Feature& feature) {
    feature.check_properties();
    Nav2Edge edge;
    edge.route.id = feature.take_id("id");
    edge.from = feature.take_id("startid");
    edge.to = feature.take_id("endid");
    edge.offset = feature.offset();
    edge.route.cost_m = exchange::cost_in(feature.properties());
    edge.route.speed_limit_mps = exchange::speed_limit_in(feature.properties());
    counts_.unset_costs += edge.route.cost_m == 0.0;
    counts_.not_overridable_unset += edge.route.cost_m == 0.0 && !feature.properties().value("overridable", true);
    Json kept = kept_of(feature, edge.route.id);
    if (check_lines(feature)) {
      kept["geometry"] = feature.geometry();
      ++counts_.bent_lines;
    }
    edge.route.annotations = Json{{"nav2", kept}}.dump();  // also when empty: the cost of such an edge was not set
    edges_.push_back(std::move(edge));
  }

  // Whether there is more to the line than its two ends. nav2's own saver writes no coordinates at all.
  static bool check_lines(const Feature& feature) {
    const Json& geometry = feature.geometry();
    if (!geometry.contains("coordinates")) return false;
    Path path{"geometry", "coordinates"};
    const bool is_multi = geometry.at("type") == "MultiLineString";
    const Json lines = is_multi ? geometry.at("coordinates") : Json::array({geometry.at("coordinates")});
    if (!lines.is_array()) feature.fail(path, "the coordinates of a MultiLineString are an array of lines");
    std::size_t points = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      Path line_path = path;
      if (is_multi) line_path.push_back(std::to_string(i));
      if (!lines[i].is_array()) feature.fail(line_path, "a line must be an array of points");
      for (std::size_t k = 0; k < lines[i].size(); ++k) {
        Path point_path = line_path;
        point_path.push_back(std::to_string(k));
        check_point(feature, lines[i][k], point_path);
      }
      points += lines[i].size();
    }
    return points > 2;
  }

  // What has no place of its own in the graph.
  Json kept_of(Feature& feature, std::int64_t id) {
    Json kept = Json::object();
    if (id == 0) kept["id"] = 0;
    Json& properties = feature.properties();
    counts_.other_frames += properties.value("frame", "map") != "map";
    counts_.singular_operations += properties.contains("operation");
    if (!properties.empty()) kept["properties"] = properties;
    for (const auto& [key, value] : feature.json().items())
      if (key != "type" && key != "properties" && key != "geometry") kept["feature"][key] = value;
    return kept;
  }

  ImportedGraph graph() {
    std::vector<exchange::FileId> node_ids;
    std::vector<std::int64_t> edge_ids;
    for (const Nav2Node& node : nodes_) node_ids.push_back({node.id, node.offset});
    for (const Nav2Edge& edge : edges_) edge_ids.push_back(edge.route.id);
    const exchange::NodeIds nodes(std::move(node_ids), source_);
    const exchange::EdgeIds edges(edge_ids);
    ImportedGraph imported;
    for (Nav2Node& node : nodes_) {
      node.landmark.id = nodes.landmark_of(node.id);
      imported.graph.add(std::move(node.landmark));
    }
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      edges_[i].route.id = edges.route_of(i);
      add_route(edges_[i], nodes, imported.graph);
    }
    warn(imported, nodes, edges);
    return imported;
  }

  void add_route(Nav2Edge& edge, const exchange::NodeIds& nodes, LandmarkGraph& graph) const {
    const auto end = [&](std::int64_t id, const char* key) {
      const LandmarkId landmark = nodes.landmark_of(id);
      if (landmark == 0)
        source_.fail(exchange::offset_of(source_, edge.offset, {"properties", key}),
                     std::string(key) + ": there is no node " + std::to_string(id));
      return landmark;
    };
    Route& route = edge.route;
    route.from = end(edge.from, "startid");
    route.to = end(edge.to, "endid");
    if (route.cost_m == 0.0)
      route.cost_m =
          (graph.find(route.from)->T_map_landmark.position() - graph.find(route.to)->T_map_landmark.position()).norm();
    graph.add_route(std::move(route));
  }

  void warn(ImportedGraph& imported, const exchange::NodeIds& nodes, const exchange::EdgeIds& edges) const {
    const auto report = [&](std::size_t count, const char* noun, const std::string& sentence) {
      exchange::warn_of(count, noun, sentence, imported.warnings);
    };
    if (crs_.empty()) {
      imported.warnings.emplace_back("there is no crs: coordinates are taken as metres in the map frame");
    } else if (!exchange::is_nav2_crs(crs_)) {
      imported.warnings.push_back("crs is " + in_quotes(crs_) +
                                  ", not EPSG:3857: coordinates are taken as metres in the map frame");
    }
    nodes.warn_of_zero(imported.warnings, "; an export writes 0 again");
    report(edges.renumbered(), "edge", "id 0 or an id that an earlier edge has, a new id is given");
    report(counts_.unset_costs, "edge", "no cost (absent or 0), the straight length is taken");
    report(counts_.not_overridable_unset, "edge", "no cost and not overridable, nav2 refuses to search such a graph");
    report(counts_.heights, "node", "the third coordinate is kept, but not used");
    report(counts_.bent_lines, "edge", "the line has more than two points: kept, but not used as the path, as in nav2");
    report(counts_.other_frames, "feature", "the frame is not \"map\"; coordinates are taken as they are");
    report(counts_.singular_operations, "feature", "nav2 reads \"operations\", not \"operation\"");
    if (edges_.empty()) imported.warnings.emplace_back("there is no edge: nav2 refuses such a graph");
    exchange::warn_of_shared_names(imported.graph, imported.warnings);
  }

  const SourceText& source_;
  std::string crs_;
  bool is_collection_ = false;
  std::vector<Nav2Node> nodes_;
  std::vector<Nav2Edge> edges_;
  Counts counts_;
};

}  // namespace

ImportedGraph parse_nav2_routes(std::string_view text, const std::string& file_name) {
  const SourceText source(text, file_name);
  return Nav2Reader(source).read();
}

}  // namespace cairn
