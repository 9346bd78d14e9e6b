#include "maps/exchange/graphs/graph_file.hpp"

#include <algorithm>
#include <array>

#include "maps/base/source_text.hpp"
#include "maps/exchange/graphs/graph_list.hpp"
#include "maps/exchange/graphs/graphml.hpp"
#include "maps/exchange/graphs/nav2_routes.hpp"

namespace cairn {
namespace {

struct Extension {
  const char* text;
  GraphFormat format;
};
constexpr std::array kExtensions{Extension{".graph", GraphFormat::list}, Extension{".geojson", GraphFormat::nav2},
                                 Extension{".json", GraphFormat::nav2}, Extension{".graphml", GraphFormat::graphml}};

}  // namespace

std::vector<std::string> graph_extensions() {
  std::vector<std::string> texts;
  texts.reserve(kExtensions.size());
  for (const Extension& extension : kExtensions) texts.emplace_back(extension.text);
  return texts;
}

std::optional<GraphFormat> graph_format_of(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  const auto found = std::ranges::find(kExtensions, extension, &Extension::text);
  return found == kExtensions.end() ? std::nullopt : std::optional(found->format);
}

ImportedGraph read_graph_file(const std::filesystem::path& file, GraphFormat format) {
  const std::string text = exchange::text_of_file(file);
  switch (format) {
    case GraphFormat::list:
      return parse_graph_list(text, file.string());
    case GraphFormat::nav2:
      return parse_nav2_routes(text, file.string());
    case GraphFormat::graphml:
      return parse_graphml(text, file.string());
  }
  throw std::logic_error("read_graph_file: no such format");
}

ExportedGraph graph_text_of(const LandmarkGraph& graph, GraphFormat format) {
  switch (format) {
    case GraphFormat::list:
      return graph_list_of(graph);
    case GraphFormat::nav2:
      return nav2_routes_of(graph);
    case GraphFormat::graphml:
      return graphml_of(graph);
  }
  throw std::logic_error("graph_text_of: no such format");
}

}  // namespace cairn
