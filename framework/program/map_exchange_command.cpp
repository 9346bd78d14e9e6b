#include <fmt/format.h>

#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "framework/program/commands.hpp"
#include "framework/program/output_files.hpp"
#include "framework/program/run_pictures.hpp"
#include "maps/exchange/graph_file.hpp"
#include "maps/hierarchy/hierarchy.hpp"
#include "maps/map_store.hpp"
#include "maps/spelling.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

[[noreturn]] void fail_extension(const std::filesystem::path& file, const char* verb,
                                 const std::vector<std::string>& known) {
  std::string list;
  for (const std::string& extension : known) list += (list.empty() ? "" : ", ") + extension;
  const std::string extension = file.extension().string();
  throw std::runtime_error(file.string() + ": cannot be " + verb + ": " +
                           (extension.empty() ? "it has no extension" : "unknown extension " + shown(extension)) +
                           did_you_mean(extension, known) + "; known are " + list);
}

void tell(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) std::cerr << "  " << warning << "\n";
}

}  // namespace

int map_import(const ExchangeCommand& command, const CommonOptions& common) {
  const std::optional<GraphFormat> format = graph_format_of(command.from);
  if (!format) fail_extension(command.from, "imported", graph_extensions());
  ImportedGraph imported = read_graph_file(command.from, *format);
  SavedMap map;
  map.graph = std::move(imported.graph);
  map.clusters = cluster_landmarks(map.graph);
  map.properties["imported_from"] = command.from.filename().string();
  save_map(command.to, map);
  const std::size_t landmarks = map.graph.landmarks().size();
  const std::size_t routes = map.graph.routes().size();
  (common.json ? std::cerr : std::cout) << fmt::format("wrote {}: {} landmarks, {} routes\n", command.to.string(),
                                                       landmarks, routes);
  tell(imported.warnings);
  if (common.json)
    std::cout << ordered_json{{"map", command.to.string()},
                              {"landmarks", landmarks},
                              {"routes", routes},
                              {"warnings", imported.warnings}}
                     .dump(-1, ' ', false, ordered_json::error_handler_t::replace)
              << "\n";
  return kExitDone;
}

int map_export(const ExchangeCommand& command, const CommonOptions& common) {
  const bool is_picture = command.to.extension() == ".png";
  const std::optional<GraphFormat> format = graph_format_of(command.to);
  if (!format && !is_picture) {
    std::vector<std::string> known = graph_extensions();
    known.emplace_back(".png");
    fail_extension(command.to, "exported to", known);
  }
  const SavedMap map = load_map(command.from);
  std::vector<std::string> warnings;
  if (is_picture) {
    draw_saved_map(command.to, map, command.from.filename().string());
  } else {
    const ExportedGraph exported = graph_text_of(map.graph, *format);
    write_file(command.to, exported.text);
    warnings = exported.warnings;
  }
  (common.json ? std::cerr : std::cout) << "wrote " << command.to.string() << "\n";
  tell(warnings);
  if (common.json)
    std::cout << ordered_json{{"file", command.to.string()},
                              {"landmarks", map.graph.landmarks().size()},
                              {"routes", map.graph.routes().size()},
                              {"warnings", warnings}}
                     .dump(-1, ' ', false, ordered_json::error_handler_t::replace)
              << "\n";
  return kExitDone;
}

}  // namespace cairn
