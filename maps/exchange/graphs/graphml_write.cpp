#include <algorithm>

#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/exchange/graphs/graphml.hpp"
#include "maps/exchange/graphs/losses.hpp"

namespace cairn {
namespace {

constexpr const char* kHead =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
<key id="n_x" for="node" attr.name="x" attr.type="double"/>
<key id="n_y" for="node" attr.name="y" attr.type="double"/>
<key id="n_theta" for="node" attr.name="theta_rad" attr.type="double"/>
<key id="n_level" for="node" attr.name="level" attr.type="int"/>
<key id="n_name" for="node" attr.name="name" attr.type="string"/>
<key id="n_category" for="node" attr.name="category" attr.type="string"/>
<key id="n_annotations" for="node" attr.name="annotations" attr.type="string"/>
)";
// Where a landmark is a printed marker.
constexpr const char* kMarkerKey =
    R"(<key id="n_marker" for="node" attr.name="april_tag" attr.type="string"/>
)";
constexpr const char* kHeadEnd =
    R"(<key id="e_weight" for="edge" attr.name="weight" attr.type="double"/>
<key id="e_closed" for="edge" attr.name="closed" attr.type="boolean"/>
<key id="e_driven" for="edge" attr.name="driven" attr.type="boolean"/>
<key id="e_level" for="edge" attr.name="level" attr.type="int"/>
<key id="e_speed_limit" for="edge" attr.name="speed_limit_mps" attr.type="double"/>
<key id="e_annotations" for="edge" attr.name="annotations" attr.type="string"/>
<graph id="landmarks" edgedefault="directed">
)";

class GraphmlWriter {
 public:
  ExportedGraph write(const LandmarkGraph& graph) {
    text_ = kHead;
    if (std::ranges::any_of(graph.landmarks(), [](const auto& entry) { return entry.second.marker.has_value(); }))
      text_ += kMarkerKey;
    text_ += kHeadEnd;
    for (const auto& [id, landmark] : graph.landmarks()) write_node(landmark);
    for (const auto& [id, route] : graph.routes()) write_edge(route);
    text_ += "</graph>\n</graphml>\n";
    exchange::Holds holds;
    holds.category = holds.heading = holds.level = holds.annotations = holds.speed_limit = holds.marker = true;
    holds.driven = holds.closed = holds.route_ids = true;
    ExportedGraph exported{std::move(text_), exchange::warnings_of_loss(graph, holds)};
    if (changed_ > 0)
      exported.warnings.push_back(counted(changed_, "text") +
                                  ": what XML cannot hold (control characters) is written as \"?\"");
    return exported;
  }

 private:
  void write_node(const Landmark& landmark) {
    text_ += "<node id=\"L" + std::to_string(landmark.id) + "\">";
    data("n_x", landmark.T_map_landmark.x_m);
    data("n_y", landmark.T_map_landmark.y_m);
    if (landmark.T_map_landmark.theta_rad != 0.0) data("n_theta", landmark.T_map_landmark.theta_rad);
    if (landmark.level != 0) data("n_level", std::to_string(landmark.level));
    if (!landmark.name.empty()) data("n_name", landmark.name);
    if (!landmark.category.empty()) data("n_category", landmark.category);
    if (!landmark.annotations.empty()) data("n_annotations", landmark.annotations);
    if (landmark.marker) data("n_marker", text_of(*landmark.marker));
    text_ += "</node>\n";
  }

  void write_edge(const Route& route) {
    text_ += "<edge id=\"e" + std::to_string(route.id) + "\" source=\"L" + std::to_string(route.from) +
             "\" target=\"L" + std::to_string(route.to) + "\">";
    data("e_weight", route.cost_m);
    if (route.closed) data("e_closed", "true");
    if (route.driven) data("e_driven", "true");
    if (route.level != 0) data("e_level", std::to_string(route.level));
    if (route.speed_limit_mps) data("e_speed_limit", *route.speed_limit_mps);
    if (!route.annotations.empty()) data("e_annotations", route.annotations);
    text_ += "</edge>\n";
  }

  void data(const char* key, double value) { data(key, exchange::number_text(value)); }
  void data(const char* key, const std::string& value) {
    text_ += "<data key=\"" + std::string(key) + "\">";
    append_escaped(value);
    text_ += "</data>";
  }

  void append_escaped(const std::string& value) {
    const bool is_text = exchange::first_not_utf8(value) == std::string::npos;
    bool is_changed = false;
    for (const char c : value) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '&') {
        text_ += "&amp;";
      } else if (c == '<') {
        text_ += "&lt;";
      } else if (c == '>') {
        text_ += "&gt;";
      } else if ((byte < 0x20U && c != '\t' && c != '\n') || (byte >= 0x80U && !is_text)) {
        text_ += '?';
        is_changed = true;
      } else {
        text_ += c;
      }
    }
    changed_ += is_changed;
  }

  std::string text_;
  std::size_t changed_ = 0;
};

}  // namespace

ExportedGraph graphml_of(const LandmarkGraph& graph) {
  return GraphmlWriter().write(graph);
}

}  // namespace cairn
