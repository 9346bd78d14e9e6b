// Landmark graphs in files of other tools: which formats there are, by the file's extension.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "maps/exchange/graphs/exchanged_graph.hpp"

namespace cairn {

enum class GraphFormat { list, nav2, graphml };

// ".graph", ".geojson", ".json", ".graphml"
[[nodiscard]] std::vector<std::string> graph_extensions();
[[nodiscard]] std::optional<GraphFormat> graph_format_of(const std::filesystem::path& file);

// Throws ExchangeError: no such file, larger than 4 GB, or as the format's parse function does. Opens no other file.
[[nodiscard]] ImportedGraph read_graph_file(const std::filesystem::path& file, GraphFormat format);
[[nodiscard]] ExportedGraph graph_text_of(const LandmarkGraph& graph, GraphFormat format);

}  // namespace cairn
