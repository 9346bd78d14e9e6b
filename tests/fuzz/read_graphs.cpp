// What a graph reader takes is sound, and survives a round trip.
#include <algorithm>
#include <array>
#include <cmath>

#include "framework/files/rmf_file.hpp"
#include "maps/base/json_text.hpp"
#include "maps/base/source_text.hpp"
#include "maps/exchange/graph_lists/graph_list.hpp"
#include "maps/exchange/graph_lists/patrolling_graph.hpp"
#include "maps/exchange/graph_lists/tntp.hpp"
#include "maps/exchange/graphs/exchanged_graph.hpp"
#include "maps/exchange/graphs/graphml.hpp"
#include "maps/exchange/graphs/nav2_routes.hpp"
#include "maps/exchange/graphs/rmf_nav_graph.hpp"
#include "tests/fuzz/reader.hpp"

namespace cairn::fuzz {
namespace {

void check(const LandmarkGraph& graph) {
  promise(!graph.landmarks().empty(), "a file without a landmark is refused");
  for (const auto& [id, landmark] : graph.landmarks())
    promise(landmark.T_map_landmark.position().allFinite(), "a landmark has a place");
  for (const auto& [id, route] : graph.routes())
    promise(route.cost_m >= 0.0 && std::isfinite(route.cost_m), "a route has a cost");
}

// What parse() refuses by its own error is fine; and what it takes, it takes again once written.
template <class Refusal = ExchangeError, class Parse, class Write>
void exchange(Input input, Parse parse, Write write) {
  ImportedGraph read;
  try {
    read = parse(text_of(input), "fuzzed");
  } catch (const Refusal&) {
    return;
  }
  check(read.graph);
  const ImportedGraph again = parse(write(read).text, "written");
  promise(again.graph.landmarks().size() == read.graph.landmarks().size(), "no landmark is lost by writing");
  const std::string written = write(again).text;  // ids have settled now
  promise(write(parse(written, "written again")).text == written, "a written file reads as what was written");
}

ImportedGraph parse_rmf(std::string_view text, const std::string& file_name) {
  const ConfigValue root = parse_config_text(std::string(text), file_name);
  if (!is_rmf(root)) throw ConfigError(root.place, "no file of Open-RMF");
  return rmf_graph_of(root);
}

// Two landmarks on a floor, a third on another, and a route, with what other tools keep with them.
LandmarkGraph annotated(const std::string& of_landmark, const std::string& of_route) {
  LandmarkGraph graph;
  for (int i = 0; i < 3; ++i) {
    Landmark landmark;
    landmark.T_map_landmark = {1.0 * i, 0.0, 0.0};
    landmark.level = i / 2;
    if (i != 1) landmark.annotations = of_landmark;
    graph.add(std::move(landmark));
  }
  Route route;
  route.from = 1;
  route.to = 2;
  route.cost_m = 1.0;
  route.annotations = of_route;
  graph.add_route(std::move(route));
  return graph;
}

// What is written of odd annotations need not be what the reader takes.
template <class Refusal, class Parse>
void read_again(const ExportedGraph& written, Parse parse) {
  try {
    check(parse(written.text, "written").graph);
  } catch (const Refusal&) {
  }
}

}  // namespace

void read_patrolling_graph(Input input) {
  try {
    check(parse_patrolling_graph(text_of(input), "fuzzed").graph);
  } catch (const ExchangeError&) {
  }
}

void read_tntp(Input input) {
  const std::string_view text = text_of(input);
  const std::size_t end = text.find('\0');
  if (end == std::string_view::npos) return;
  try {
    check(parse_tntp({text.substr(0, end), "net", text.substr(end + 1), "node"}).graph);
  } catch (const ExchangeError&) {
  }
}

void read_graph_list(Input input) {
  exchange(input, parse_graph_list, [](const ImportedGraph& read) { return graph_list_of(read.graph); });
}

void read_graphml(Input input) {
  exchange(input, parse_graphml, [](const ImportedGraph& read) { return graphml_of(read.graph); });
}

void read_nav2_routes(Input input) {
  exchange(input, parse_nav2_routes, [](const ImportedGraph& read) { return nav2_routes_of(read.graph); });
}

// Buildings too: they are written as navigation graphs.
void read_rmf(Input input) {
  exchange<ConfigError>(input, parse_rmf, [](const ImportedGraph& read) {
    return rmf_nav_graph_of(read.graph, read.properties.at("rmf"));
  });
}

void read_annotations(Input input) {
  std::array<std::string, 3> parts;  // of a landmark, a route, the site
  std::string_view text = text_of(input);
  for (std::string& part : parts) {
    part = text.substr(0, text.find('\0'));
    text.remove_prefix(std::min(part.size() + 1, text.size()));
    if (!part.empty() && !exchange::is_json_object(part)) return;  // no map has such
  }
  const LandmarkGraph graph = annotated(parts[0], parts[1]);
  read_again<ExchangeError>(graphml_of(graph), parse_graphml);
  read_again<ExchangeError>(nav2_routes_of(graph), parse_nav2_routes);
  read_again<ConfigError>(rmf_nav_graph_of(graph, parts[2]), parse_rmf);
}

}  // namespace cairn::fuzz
