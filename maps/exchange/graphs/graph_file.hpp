// Landmark graphs in files of other tools: which formats there are, by the file's extension.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "maps/exchange/graphs/exchanged_graph.hpp"

namespace cairn {

enum class GraphFormat { list, nav2, graphml, tntp };

// ".graph", ".geojson", ".json", ".graphml", ".tntp"; those that are written too, or all that are read.
enum class GraphUse { read, written };
[[nodiscard]] std::vector<std::string> graph_extensions(GraphUse use);
// The extension without a last ".gz": what is compressed may be read.
[[nodiscard]] std::string extension_of(const std::filesystem::path& file);
[[nodiscard]] std::optional<GraphFormat> graph_format_of(const std::filesystem::path& file);

// Throws ExchangeError: no such file, larger than 4 GB, or as the format's parse function does. Of tntp the file is
// NAME_net.tntp, and NAME_node.tntp beside it is read too; no other format opens another file. Not compressed or by
// gzip. A .graph may be a plain list or one of patrolling_sim.
[[nodiscard]] ImportedGraph read_graph_file(const std::filesystem::path& file, GraphFormat format);
// Throws std::logic_error for tntp, which is only read.
[[nodiscard]] ExportedGraph graph_text_of(const LandmarkGraph& graph, GraphFormat format);

}  // namespace cairn
