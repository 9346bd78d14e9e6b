#include "maps/exchange/graphs/graph_file.hpp"

#include <algorithm>
#include <array>

#include "maps/base/source_text.hpp"
#include "maps/exchange/graph_lists/graph_list.hpp"
#include "maps/exchange/graph_lists/patrolling_graph.hpp"
#include "maps/exchange/graph_lists/tntp.hpp"
#include "maps/exchange/graphs/graphml.hpp"
#include "maps/exchange/graphs/nav2_routes.hpp"

namespace cairn {
namespace {

struct Extension {
  const char* text;
  GraphFormat format;
};
constexpr std::array kExtensions{Extension{".graph", GraphFormat::list}, Extension{".geojson", GraphFormat::nav2},
                                 Extension{".json", GraphFormat::nav2}, Extension{".graphml", GraphFormat::graphml},
                                 Extension{".tntp", GraphFormat::tntp}};
constexpr std::string_view kNet = "_net";

ImportedGraph read_tntp(const std::filesystem::path& net) {
  std::filesystem::path name = net.filename();
  while (name.has_extension()) name = name.stem();
  std::string stem = name.string();
  if (!stem.ends_with(kNet))
    throw ExchangeError(net.string() +
                        ": a road network is named by its links, NAME_net.tntp; its nodes are read from "
                        "NAME_node.tntp beside it");
  stem.resize(stem.size() - kNet.size());
  std::filesystem::path node = net.parent_path() / (stem + "_node.tntp");
  if (!std::filesystem::exists(node)) {
    node += ".gz";
    if (!std::filesystem::exists(node))
      throw ExchangeError(net.string() + ": its nodes are missing: there is no " + stem + "_node.tntp beside it");
  }
  const std::string links = exchange::text_of_file(net);
  const std::string nodes = exchange::text_of_file(node);
  return parse_tntp({links, net.string(), nodes, node.string()});
}

}  // namespace

std::vector<std::string> graph_extensions(GraphUse use) {
  std::vector<std::string> texts;
  texts.reserve(kExtensions.size());
  for (const Extension& extension : kExtensions)
    if (use == GraphUse::read || extension.format != GraphFormat::tntp) texts.emplace_back(extension.text);
  return texts;
}

std::string extension_of(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".gz" ? file.stem().extension().string() : extension;
}

std::optional<GraphFormat> graph_format_of(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  const auto found = std::ranges::find(kExtensions, extension, &Extension::text);
  return found == kExtensions.end() ? std::nullopt : std::optional(found->format);
}

ImportedGraph read_graph_file(const std::filesystem::path& file, GraphFormat format) {
  if (format == GraphFormat::tntp) return read_tntp(file);
  const std::string text = exchange::text_of_file(file);
  switch (format) {
    case GraphFormat::list:
      return is_patrolling_graph(text) ? parse_patrolling_graph(text, file.string())
                                       : parse_graph_list(text, file.string());
    case GraphFormat::nav2:
      return parse_nav2_routes(text, file.string());
    case GraphFormat::graphml:
      return parse_graphml(text, file.string());
    case GraphFormat::tntp:
      break;
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
    case GraphFormat::tntp:
      break;
  }
  throw std::logic_error("graph_text_of: no such format");
}

}  // namespace cairn
