#include <algorithm>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <unordered_map>

#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"
#include "maps/exchange/graphs/crs.hpp"
#include "maps/exchange/graphs/file_ids.hpp"
#include "maps/exchange/graphs/graphml.hpp"
#include "maps/exchange/graphs/graphml_values.hpp"
#include "maps/exchange/graphs/imported_names.hpp"

namespace cairn {
namespace {

using exchange::GraphmlValues;
using exchange::SourceText;
using Names = std::vector<std::string>;

struct Key {
  std::string name;
  std::string type;
  std::string domain;
  pugi::xml_node fallback;  // <default>
  bool is_drawing = false;  // yEd's
};

std::size_t offset_of(const pugi::xml_node& node) {
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
}

struct Drawn {
  std::optional<Point> at;  // in the middle of its shape; yEd's y goes down
  std::string label;
};

class GraphmlReader {
 public:
  explicit GraphmlReader(const SourceText& source) : source_(source) {}

  ImportedGraph read() {
    // Its own copy: pugixml writes into what it parses. Entities of a DOCTYPE are never expanded.
    const auto flags = pugi::parse_default | pugi::parse_ws_pcdata_single;
    const pugi::xml_parse_result parsed =
        document_.load_buffer(source_.text().data(), source_.text().size(), flags, pugi::encoding_utf8);
    const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(parsed.offset, 0));
    if (!parsed) fail_no_xml(offset, parsed.description());
    const pugi::xml_node root = document_.document_element();
    if (std::string_view(root.name()) != "graphml")
      source_.fail(offset_of(root), "is not GraphML: its outer element is <" + std::string(root.name()) + ">");
    read_keys(root);
    const pugi::xml_node graph = only_graph(root);
    read_crs(graph);
    read_elements(graph);
    if (nodes_.empty()) source_.fail(offset_of(graph), "the graph holds no node");
    take_nodes();
    take_edges(std::string_view(graph.attribute("edgedefault").value()) == "undirected");
    warn();
    return std::move(imported_);
  }

 private:
  [[noreturn]] void fail_no_xml(std::size_t offset, const std::string& why) const {
    const std::size_t last_tag = source_.text().rfind("</");
    const bool is_whole =
        last_tag != std::string_view::npos && source_.text().find("graphml>", last_tag) != std::string_view::npos;
    if (is_whole) source_.fail(offset, "is not XML: " + why);
    source_.fail_cut(offset, "is not XML: " + why);
  }

  void require_known(const pugi::xml_node& child, const Names& known) const {
    const std::string name = child.name();
    if (child.type() != pugi::node_element || name.find(':') != std::string::npos ||
        std::ranges::find(known, name) != known.end())
      return;
    source_.fail(offset_of(child),
                 "unknown element <" + name + ">" + did_you_mean(name, known) + " in <" + child.parent().name() + ">");
  }

  void read_keys(const pugi::xml_node& root) {
    for (const pugi::xml_node& key : root.children("key")) {
      const std::string id = key.attribute("id").value();
      if (id.empty()) source_.fail(offset_of(key), "a key needs an id");
      std::string name = key.attribute("attr.name").value();
      if (name.empty()) name = id;
      exchange::check_text(source_, name, offset_of(key));
      const std::string domain = key.attribute("for").value();
      const bool is_drawing = !key.attribute("yfiles.type").empty();
      const Key read{name, key.attribute("attr.type").value(), domain, key.child("default"), is_drawing};
      if (!keys_.emplace(id, read).second) source_.fail(offset_of(key), "the key " + in_quotes(id) + " is there twice");
    }
  }

  [[nodiscard]] const Key& key_of(const pugi::xml_node& data) const {
    const std::string_view id = data.attribute("key").value();
    const auto key = keys_.find(id);
    if (key == keys_.end()) source_.fail(offset_of(data), "the key " + in_quotes(id) + " is not declared");
    return key->second;
  }

  [[nodiscard]] GraphmlValues values_of(const pugi::xml_node& owner) const {
    std::vector<exchange::GraphmlValue> values;
    for (const pugi::xml_node& data : owner.children("data"))
      if (const Key& key = key_of(data); !key.is_drawing)
        values.push_back({key.name, key.type, data.child_value(), offset_of(data)});
    for (const auto& [id, key] : keys_) {
      const bool applies = !key.fallback.empty() && (key.domain == owner.name() || key.domain == "all");
      if (applies && std::ranges::find(values, key.name, &exchange::GraphmlValue::name) == values.end())
        values.push_back({key.name, key.type, key.fallback.child_value(), offset_of(key.fallback)});
    }
    return {source_, std::move(values)};
  }

  [[nodiscard]] Drawn drawn_of(const pugi::xml_node& node) const {
    for (const pugi::xml_node& data : node.children("data")) {
      if (!key_of(data).is_drawing) continue;
      const pugi::xml_node shape =
          data.find_child([](const pugi::xml_node& child) { return child.child("y:Geometry"); });
      const pugi::xml_node geometry = shape.child("y:Geometry");
      const Point middle(geometry.attribute("x").as_double() + 0.5 * geometry.attribute("width").as_double(),
                         -geometry.attribute("y").as_double() - 0.5 * geometry.attribute("height").as_double());
      const bool is_placed = geometry.attribute("x") && geometry.attribute("y") &&
                             middle.cwiseAbs().maxCoeff() <= exchange::kMaxCoordinate_m;
      const std::string_view label = shape.child("y:NodeLabel").child_value();
      exchange::check_text(source_, label, offset_of(shape));
      return {is_placed ? std::optional(middle) : std::nullopt, std::string(trimmed(label, exchange::kXmlBlanks))};
    }
    return {};
  }

  [[nodiscard]] pugi::xml_node only_graph(const pugi::xml_node& root) const {
    for (const pugi::xml_node& child : root.children()) require_known(child, {"key", "graph", "desc", "data"});
    const pugi::xml_node graph = root.child("graph");
    if (graph.empty()) source_.fail(offset_of(root), "holds no graph");
    if (const pugi::xml_node second = graph.next_sibling("graph"); !second.empty())
      source_.fail(offset_of(second), "holds a second graph: a map has one");
    const std::string_view direction = graph.attribute("edgedefault").value();
    if (direction != "directed" && direction != "undirected")
      source_.fail(offset_of(graph), "edgedefault must be directed or undirected, is " + in_quotes(direction));
    return graph;
  }

  void read_crs(const pugi::xml_node& graph) const {
    GraphmlValues values = values_of(graph);
    const std::optional<exchange::GraphmlValue> crs = values.take({"crs"});
    if (crs && exchange::is_geographic_crs(crs->text))
      source_.fail(crs->offset, "crs " + in_quotes(crs->text) +
                                    " has degrees of longitude and latitude; a map needs metres in its own frame");
  }

  void read_elements(const pugi::xml_node& graph) {
    static const Names kKnown{"node", "edge", "data", "desc", "hyperedge", "locator"};
    for (const pugi::xml_node& child : graph.children()) {
      require_known(child, kKnown);
      const std::string_view name = child.name();
      if (name == "hyperedge") source_.fail(offset_of(child), "a hyperedge is not a route: edges have two ends");
      if (name == "node") read_node(child);
      if (name == "edge") edges_.push_back(child);
    }
  }

  void read_node(const pugi::xml_node& node) {
    if (const pugi::xml_node inner = node.child("graph"); !inner.empty())
      source_.fail(offset_of(inner), "a graph within a node is not read");
    const std::string_view id = node.attribute("id").value();
    if (id.empty()) source_.fail(offset_of(node), "a node needs an id");
    exchange::check_text(source_, id, offset_of(node));
    const auto [earlier, is_new] = index_.emplace(id, nodes_.size());
    if (!is_new)
      source_.fail(offset_of(node), "node " + in_quotes(id) + " is there already, in line " +
                                        std::to_string(source_.line_of(offset_of(nodes_[earlier->second]))));
    nodes_.push_back(node);
  }

  void take_nodes() {
    std::vector<std::string_view> ids;
    std::vector<exchange::FileId> file_ids;
    for (const pugi::xml_node& node : nodes_) ids.emplace_back(node.attribute("id").value());
    const auto numbers = exchange::numbers_of(ids);
    for (std::size_t i = 0; i < ids.size(); ++i)
      file_ids.push_back({numbers ? (*numbers)[i] : static_cast<std::int64_t>(i + 1), offset_of(nodes_[i])});
    const exchange::NodeIds landmark_ids(file_ids, source_);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      GraphmlValues values = values_of(nodes_[i]);
      Landmark landmark;
      landmark.id = landmark_ids.landmark_of(file_ids[i].id);
      if (!numbers) landmark.name = ids[i];
      take_node(values, landmark, nodes_[i]);
      if (landmark.name.empty() && file_ids[i].id == 0) landmark.name = ids[i];
      exchange::check_name(source_, offset_of(nodes_[i]), "name", landmark.name);
      exchange::check_name(source_, offset_of(nodes_[i]), "category", landmark.category);
      landmarks_.push_back(landmark.id);
      imported_.graph.add(std::move(landmark));
    }
    if (!numbers) imported_.warnings.emplace_back("the ids of nodes are no numbers: they are the landmarks' names");
    landmark_ids.warn_of_zero(imported_.warnings);
  }

  void take_node(GraphmlValues& values, Landmark& landmark, const pugi::xml_node& node) {
    const std::optional<double> x_m = values.take_coordinate({"x", "x_m"});
    const std::optional<double> y_m = values.take_coordinate({"y", "y_m"});
    const Drawn drawn = drawn_of(node);
    if (x_m && y_m) {
      landmark.T_map_landmark = {*x_m, *y_m, 0.0};
    } else if (drawn.at) {
      landmark.T_map_landmark = {drawn.at->x(), drawn.at->y(), 0.0};
      ++drawn_;
    } else {
      source_.fail(offset_of(node),
                   "node " + in_quotes(node.attribute("id").value()) + " has no place: the keys x and y, in metres");
    }
    landmark.T_map_landmark.theta_rad = values.take_number({"theta_rad"}).value_or(0.0);
    landmark.level = values.take_level();
    if (landmark.name.empty()) landmark.name = values.take_text({"name", "label"});
    if (landmark.name.empty()) landmark.name = drawn.label;
    landmark.category = values.take_text({"category", "class"});
    landmark.marker = values.take_marker();
    landmark.annotations = values.take_annotations();
  }

  void take_edges(bool is_undirected) {
    std::vector<std::string_view> ids;
    bool all_directed = true;
    for (const pugi::xml_node& edge : edges_) {
      ids.emplace_back(edge.attribute("id").value());
      all_directed = all_directed && edge.attribute("directed").as_bool(!is_undirected);
    }
    const auto numbers = all_directed ? exchange::numbers_of(ids) : std::nullopt;
    const exchange::EdgeIds route_ids(numbers.value_or(std::vector<std::int64_t>{}));
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      Route route = route_of(edges_[i]);
      if (numbers) route.id = route_ids.route_of(i);
      Route back = route;
      std::swap(back.from, back.to);
      imported_.graph.add_route(std::move(route));
      if (!edges_[i].attribute("directed").as_bool(!is_undirected)) imported_.graph.add_route(std::move(back));
    }
  }

  [[nodiscard]] LandmarkId end_of(const pugi::xml_node& edge, const char* end) const {
    const std::string_view id = edge.attribute(end).value();
    const auto found = index_.find(id);
    if (found == index_.end()) source_.fail(offset_of(edge), std::string(end) + ": there is no node " + in_quotes(id));
    return landmarks_[found->second];
  }

  Route route_of(const pugi::xml_node& edge) {
    Route route;
    route.from = end_of(edge, "source");
    route.to = end_of(edge, "target");
    GraphmlValues values = values_of(edge);
    const std::optional<double> cost_m = values.take_number({"cost_m", "cost", "weight", "length", "distance"});
    if (cost_m && *cost_m < 0.0)
      source_.fail(offset_of(edge),
                   "the cost " + exchange::number_text(*cost_m) + " is not allowed: it must not be negative");
    const Point from = imported_.graph.find(route.from)->T_map_landmark.position();
    route.cost_m = cost_m.value_or((imported_.graph.find(route.to)->T_map_landmark.position() - from).norm());
    unset_costs_ += !cost_m;
    route.closed = values.take_flag("closed");
    route.driven = values.take_flag("driven");
    route.level = values.take_level();
    route.speed_limit_mps = values.take_number({"speed_limit_mps"});
    if (route.speed_limit_mps && !(*route.speed_limit_mps > 0.0))
      source_.fail(offset_of(edge), "speed_limit_mps " + exchange::number_text(*route.speed_limit_mps) +
                                        " is not allowed: it must be above 0");
    route.annotations = values.take_annotations();
    return route;
  }

  void warn() {
    if (unset_costs_ > 0)
      imported_.warnings.push_back(counted(unset_costs_, "edge") +
                                   ": no cost (cost, weight or length), the straight length is taken");
    if (drawn_ > 0)
      imported_.warnings.push_back(counted(drawn_, "node") +
                                   ": no x and y, the place in yEd's drawing is taken as metres, y upwards");
    exchange::warn_of_shared_names(imported_.graph, imported_.warnings);
  }

  const SourceText& source_;
  pugi::xml_document document_;
  std::map<std::string, Key, std::less<>> keys_;
  std::vector<pugi::xml_node> nodes_;
  std::vector<pugi::xml_node> edges_;
  std::unordered_map<std::string_view, std::size_t> index_;  // of a node, by its id
  std::vector<LandmarkId> landmarks_;                        // of the nodes
  ImportedGraph imported_;
  std::size_t drawn_ = 0;
  std::size_t unset_costs_ = 0;
};

}  // namespace

ImportedGraph parse_graphml(std::string_view text, const std::string& file_name) {
  const SourceText source(text, file_name);
  return GraphmlReader(source).read();
}

}  // namespace cairn
