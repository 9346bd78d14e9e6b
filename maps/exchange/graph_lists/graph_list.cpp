#include "maps/exchange/graph_lists/graph_list.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "maps/base/printable.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"
#include "maps/exchange/graphs/file_ids.hpp"
#include "maps/exchange/graphs/line_tokens.hpp"
#include "maps/exchange/graphs/losses.hpp"

namespace cairn {
namespace {

using exchange::FileId;
using exchange::kLineBlanks;
using exchange::LineTokens;
using exchange::NodeIds;
using exchange::SourceText;

constexpr const char* kNodeLine = "node ID X_M Y_M [NAME]";
constexpr const char* kEdgeLine = "edge FROM TO COST_M";

struct ListedNode {
  std::int64_t id = 0;
  double x_m = 0.0;
  double y_m = 0.0;
  std::string_view name;
  std::size_t offset = 0;  // of the id
};

struct ListedEdge {
  std::int64_t from = 0;
  std::int64_t to = 0;
  double cost_m = 0.0;
  std::size_t offset = 0;  // of `from`; `to` is the next token
};

std::string_view name_of(LineTokens& line) {
  const std::string_view name = line.rest();
  if (name.starts_with('#')) return {};
  if (const std::size_t control = first_unprintable(name); control != std::string_view::npos)
    line.fail_at(line.offset() + control, "the name " + in_quotes(name) + " holds a control character");
  return name;
}

ListedNode node_of(LineTokens& line) {
  ListedNode node;
  node.id = line.id("the node's id", kNodeLine);
  node.offset = line.offset();
  node.x_m = line.coordinate_m("x_m", kNodeLine);
  node.y_m = line.coordinate_m("y_m", kNodeLine);
  node.name = name_of(line);
  return node;
}

ListedEdge edge_of(LineTokens& line) {
  ListedEdge edge;
  edge.from = line.id("the id that the edge comes from", kEdgeLine);
  edge.offset = line.offset();
  edge.to = line.id("the id that the edge goes to", kEdgeLine);
  edge.cost_m = line.number("the cost", kEdgeLine);
  if (edge.cost_m < 0.0)
    line.fail("the cost " + exchange::number_text(edge.cost_m) + " is not allowed: it must not be negative");
  const std::string_view more = line.rest();
  if (!more.empty() && !more.starts_with('#')) line.fail(in_quotes(more) + " is too much: " + kEdgeLine);
  return edge;
}

struct ListedGraph {
  std::vector<ListedNode> nodes;
  std::vector<ListedEdge> edges;
  std::vector<std::string> warnings;
};

ListedGraph listed_in(const SourceText& source) {
  ListedGraph lines;
  LineTokens line(source);
  while (line.next_line()) {
    const std::string_view word = line.token();
    if (word == "node") {
      lines.nodes.push_back(node_of(line));
    } else if (word == "edge") {
      lines.edges.push_back(edge_of(line));
    } else if (!word.empty() && !word.starts_with('#')) {
      line.fail("unknown word " + in_quotes(word) + did_you_mean(word, {"node", "edge"}) +
                ": a line begins with node, edge or #");
    }
  }
  if (lines.nodes.empty()) source.fail("holds no node (" + std::string(kNodeLine) + ")");
  if (line.is_cut()) lines.warnings.emplace_back("the last line has no line end: the file may have been cut");
  return lines;
}

[[noreturn]] void fail_unknown_end(const SourceText& source, const ListedEdge& edge, bool from_is_known) {
  std::size_t at = edge.offset;
  if (from_is_known) at = source.text().find_first_not_of(kLineBlanks, source.text().find_first_of(kLineBlanks, at));
  source.fail(at, "there is no node " + std::to_string(from_is_known ? edge.to : edge.from));
}

void take_nodes(const std::vector<ListedNode>& nodes, const NodeIds& ids, ImportedGraph& imported) {
  for (const ListedNode& node : nodes) {
    Landmark landmark;
    landmark.id = ids.landmark_of(node.id);
    landmark.name = node.id == 0 && node.name.empty() ? "0" : std::string(node.name);
    landmark.T_map_landmark = {node.x_m, node.y_m, 0.0};
    imported.graph.add(std::move(landmark));
  }
}

void take_edges(const std::vector<ListedEdge>& edges, const NodeIds& ids, const SourceText& source,
                LandmarkGraph& graph) {
  for (const ListedEdge& edge : edges) {
    Route route;
    route.from = ids.landmark_of(edge.from);
    route.to = ids.landmark_of(edge.to);
    if (route.from == 0 || route.to == 0) fail_unknown_end(source, edge, route.from != 0);
    route.cost_m = edge.cost_m;
    graph.add_route(std::move(route));
  }
}

// Whether a node's line gives the name back as it is.
bool fits_a_line(const std::string& name) {
  return !name.starts_with('#') && name.find_first_not_of(' ') == 0 && name.back() != ' ' &&
         first_unprintable(name) == std::string::npos;
}

}  // namespace

ImportedGraph parse_graph_list(std::string_view text, const std::string& file_name) {
  const SourceText source(text, file_name);
  ListedGraph lines = listed_in(source);
  std::vector<FileId> node_ids;
  node_ids.reserve(lines.nodes.size());
  for (const ListedNode& node : lines.nodes) node_ids.push_back({node.id, node.offset});
  const NodeIds ids(std::move(node_ids), source);
  ImportedGraph imported{{}, std::move(lines.warnings)};
  take_nodes(lines.nodes, ids, imported);
  take_edges(lines.edges, ids, source, imported.graph);
  ids.warn_of_zero(imported.warnings);
  exchange::warn_of_shared_names(imported.graph, imported.warnings);
  return imported;
}

ExportedGraph graph_list_of(const LandmarkGraph& graph) {
  ExportedGraph exported;
  std::string& text = exported.text;
  text = "# " + counted(graph.landmarks().size(), "landmark") + ", " + counted(graph.routes().size(), "route") + "\n";
  std::size_t nameless = 0;
  for (const auto& [id, landmark] : graph.landmarks()) {
    text += "node " + std::to_string(id) + ' ';
    exchange::append_number(text, landmark.T_map_landmark.x_m);
    text += ' ';
    exchange::append_number(text, landmark.T_map_landmark.y_m);
    const bool has_name = !landmark.name.empty();
    if (has_name && fits_a_line(landmark.name))
      text += ' ' + landmark.name;
    else if (has_name)
      ++nameless;
    text += '\n';
  }
  for (const auto& [id, route] : graph.routes()) {
    if (route.closed) continue;
    text += "edge " + std::to_string(route.from) + ' ' + std::to_string(route.to) + ' ';
    exchange::append_number(text, route.cost_m);
    text += '\n';
  }
  exported.warnings = exchange::warnings_of_loss(graph, {});
  if (nameless > 0)
    exported.warnings.push_back(counted(nameless, "landmark") +
                                ": the name does not fit on a line of the list and is not written");
  return exported;
}

}  // namespace cairn
