#include "maps/exchange/graph_lists/tntp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "maps/base/source_text.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"
#include "maps/exchange/graphs/file_ids.hpp"
#include "maps/exchange/graphs/line_tokens.hpp"

namespace cairn {
namespace {

using exchange::FileId;
using exchange::LineTokens;
using exchange::NodeIds;
using exchange::SourceText;

constexpr const char* kLinkForm = "INIT_NODE TERM_NODE CAPACITY LENGTH ... ;";
constexpr const char* kNodeForm = "ID X Y ;";
constexpr std::string_view kLinks = "<NUMBER OF LINKS>";
constexpr std::string_view kFirstThrough = "<FIRST THRU NODE>";
constexpr std::string_view kEnd = "<END OF METADATA>";

struct Link {
  std::int64_t from = 0;
  std::int64_t to = 0;
  double length_m = 0.0;
  std::size_t from_offset = 0;
  std::size_t to_offset = 0;
};

struct Net {
  std::optional<std::int64_t> stated_links;
  std::int64_t first_through = 0;
  std::vector<Link> links;
};

struct Nodes {
  std::vector<FileId> ids;
  std::vector<Point> at_m;
};

bool is_digit(std::string_view text) {
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

// A line of the metadata. Returns false at their end.
bool take_metadata(LineTokens& line, Net& net) {
  const std::string_view text = line.rest();
  const auto value_of = [&](std::string_view key) -> std::optional<std::int64_t> {
    if (!text.starts_with(key)) return std::nullopt;
    std::string_view value = text.substr(key.size());
    value.remove_prefix(std::min(value.find_first_not_of(exchange::kLineBlanks), value.size()));
    const auto number = number_from<std::uint64_t>(value);
    if (!number || *number > exchange::kMaxFileId)
      line.fail(std::string(key) + " must be followed by a whole number, is " + in_quotes(value));
    return static_cast<std::int64_t>(*number);
  };
  if (const auto links = value_of(kLinks)) net.stated_links = *links;
  if (const auto first = value_of(kFirstThrough)) net.first_through = *first;
  if (!text.empty() && !text.starts_with('<') && !text.starts_with('~'))
    line.fail("expected <KEY> VALUE or " + std::string(kEnd) + ", found " + in_quotes(text));
  return !text.starts_with(kEnd);
}

Link link_of(LineTokens& line) {
  Link link;
  link.from = line.id("the node that the link comes from", kLinkForm);
  link.from_offset = line.offset();
  link.to = line.id("the node that the link goes to", kLinkForm);
  link.to_offset = line.offset();
  (void)line.number("the capacity", kLinkForm);
  link.length_m = line.number("the length", kLinkForm);
  if (link.length_m < 0.0) line.fail("the length must not be negative");
  return link;
}

// Whether a line of the tables holds something: a copy of the line looks ahead.
bool holds_row(LineTokens line) {
  const std::string_view first = line.token();
  return !first.empty() && !first.starts_with('~') && first != ";";
}

Net net_of(const SourceText& source) {
  Net net;
  LineTokens line(source);
  bool in_metadata = true;
  while (in_metadata) {
    if (!line.next_line()) source.fail("has no " + std::string(kEnd));
    in_metadata = take_metadata(line, net);
  }
  while (line.next_line())
    if (holds_row(line)) net.links.push_back(link_of(line));
  if (net.stated_links && *net.stated_links != static_cast<std::int64_t>(net.links.size()))
    source.fail(fmt::format("{} says {}, there are {}; the file may have been cut", kLinks, *net.stated_links,
                            net.links.size()));
  return net;
}

Nodes nodes_of(const SourceText& source) {
  Nodes nodes;
  LineTokens line(source);
  bool heading = true;  // a first line of words names the columns
  while (line.next_line()) {
    if (!holds_row(line)) continue;
    LineTokens ahead = line;
    if (heading && !is_digit(ahead.token())) {
      heading = false;
      continue;
    }
    heading = false;
    const std::int64_t id = line.id("the node's id", kNodeForm);
    nodes.ids.push_back({id, line.offset()});
    const double x_m = line.coordinate_m("x", kNodeForm);
    nodes.at_m.emplace_back(x_m, line.coordinate_m("y", kNodeForm));
  }
  if (nodes.ids.empty()) source.fail("holds no node (" + std::string(kNodeForm) + ")");
  return nodes;
}

bool look_like_degrees(const std::vector<Point>& at_m) {
  return std::ranges::all_of(at_m,
                             [](const Point& at) { return std::abs(at.x()) <= 180.0 && std::abs(at.y()) <= 90.0; });
}

void take_links(const Net& net, const NodeIds& ids, const SourceText& source, LandmarkGraph& graph) {
  for (const Link& link : net.links) {
    Route route;
    route.from = ids.landmark_of(link.from);
    route.to = ids.landmark_of(link.to);
    if (route.from == 0) source.fail(link.from_offset, fmt::format("there is no node {}", link.from));
    if (route.to == 0) source.fail(link.to_offset, fmt::format("there is no node {}", link.to));
    route.cost_m = link.length_m;
    graph.add_route(std::move(route));
  }
}

}  // namespace

ImportedGraph parse_tntp(const TntpTexts& texts) {
  const SourceText net_source(texts.net, texts.net_name);
  const SourceText node_source(texts.node, texts.node_name);
  const Net net = net_of(net_source);
  const Nodes nodes = nodes_of(node_source);
  const NodeIds ids(nodes.ids, node_source);
  ImportedGraph imported;
  std::size_t zones = 0;
  for (std::size_t i = 0; i < nodes.ids.size(); ++i) {
    Landmark landmark;
    landmark.id = ids.landmark_of(nodes.ids[i].id);
    if (nodes.ids[i].id == 0) landmark.name = "0";
    if (nodes.ids[i].id < net.first_through) landmark.category = "zone";
    zones += nodes.ids[i].id < net.first_through;
    landmark.T_map_landmark = {nodes.at_m[i].x(), nodes.at_m[i].y(), 0.0};
    imported.graph.add(std::move(landmark));
  }
  take_links(net, ids, net_source, imported.graph);
  ids.warn_of_zero(imported.warnings);
  exchange::warn_of(zones, "zone",
                    fmt::format("nodes below the first through node, {}, are passed like others", net.first_through),
                    imported.warnings);
  if (look_like_degrees(nodes.at_m))
    imported.warnings.emplace_back("the coordinates may be degrees: they are taken as metres, as are the lengths");
  return imported;
}

}  // namespace cairn
