// What a graph reader takes is sound, and survives a round trip.
#include <cmath>

#include "maps/exchange/exchanged_graph.hpp"
#include "maps/exchange/graph_list.hpp"
#include "maps/exchange/graphml.hpp"
#include "maps/exchange/nav2_routes.hpp"
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

// What parse() refuses by ExchangeError is fine; and what it takes, it takes again once written.
template <class Parse, class Write>
void exchange(Input input, Parse parse, Write write) {
  ImportedGraph read;
  try {
    read = parse(text_of(input), "fuzzed");
  } catch (const ExchangeError&) {
    return;
  }
  check(read.graph);
  const ImportedGraph again = parse(write(read.graph).text, "written");
  promise(again.graph.landmarks().size() == read.graph.landmarks().size(), "no landmark is lost by writing");
  const std::string written = write(again.graph).text;  // ids have settled now
  promise(write(parse(written, "written again").graph).text == written, "a written file reads as what was written");
}

}  // namespace

void read_graph_list(Input input) {
  exchange(input, parse_graph_list, graph_list_of);
}

void read_graphml(Input input) {
  exchange(input, parse_graphml, graphml_of);
}

void read_nav2_routes(Input input) {
  exchange(input, parse_nav2_routes, nav2_routes_of);
}

}  // namespace cairn::fuzz
