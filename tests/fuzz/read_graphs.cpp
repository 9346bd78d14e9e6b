// What a graph reader takes is sound, and survives a round trip.
#include <cmath>

#include "framework/config/rmf_file.hpp"
#include "maps/exchange/exchanged_graph.hpp"
#include "maps/exchange/graph_list.hpp"
#include "maps/exchange/graphml.hpp"
#include "maps/exchange/nav2_routes.hpp"
#include "maps/exchange/rmf_nav_graph.hpp"
#include "maps/exchange/source_text.hpp"
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

}  // namespace

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

}  // namespace cairn::fuzz
