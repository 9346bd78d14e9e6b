#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <nlohmann/json.hpp>

#include "framework/config/map_server_file.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/program/commands.hpp"
#include "framework/program/output_files.hpp"
#include "framework/program/run_pictures.hpp"
#include "maps/exchange/graph_file.hpp"
#include "maps/exchange/moving_ai_map.hpp"
#include "maps/exchange/source_text.hpp"
#include "maps/hierarchy/hierarchy.hpp"
#include "maps/map_store.hpp"
#include "maps/spelling.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kMovingAi = ".map";
constexpr std::array<std::string_view, 3> kGridExtensions{kMovingAi, ".yaml", ".yml"};
constexpr double kMovingAiCell_m = 1.0;

[[noreturn]] void fail_extension(const std::filesystem::path& file, const char* verb,
                                 const std::vector<std::string>& known) {
  std::string list;
  for (const std::string& extension : known) list += (list.empty() ? "" : ", ") + extension;
  const std::string extension = file.extension().string();
  throw std::runtime_error(file.string() + ": cannot be " + verb + ": " +
                           (extension.empty() ? "it has no extension" : "unknown extension " + shown(extension)) +
                           did_you_mean(extension, known) + "; known are " + list);
}

void tell_people(const std::string& line, const std::vector<std::string>& warnings, const CommonOptions& common) {
  (common.json ? std::cerr : std::cout) << line << "\n";
  for (const std::string& warning : warnings) std::cerr << "  " << warning << "\n";
}

std::vector<std::string> about(const std::filesystem::path& file, std::vector<std::string> warnings) {
  for (std::string& warning : warnings) warning.insert(0, file.string() + ": ");
  return warnings;
}

void tell_json(const ordered_json& json) {
  std::cout << json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) << "\n";
}

int import_graph(const ExchangeCommand& command, GraphFormat format, const CommonOptions& common) {
  ImportedGraph imported = read_graph_file(command.from, format);
  SavedMap map;
  map.graph = std::move(imported.graph);
  map.clusters = cluster_landmarks(map.graph);
  map.properties["imported_from"] = command.from.filename().string();
  save_map(command.to, map);
  const std::vector<std::string> warnings = about(command.from, std::move(imported.warnings));
  const std::size_t landmarks = map.graph.landmarks().size();
  const std::size_t routes = map.graph.routes().size();
  tell_people(fmt::format("wrote {}: {} landmarks, {} routes", command.to.string(), landmarks, routes), warnings,
              common);
  if (common.json)
    tell_json({{"map", command.to.string()}, {"landmarks", landmarks}, {"routes", routes}, {"warnings", warnings}});
  return kExitDone;
}

ImportedGrid read_grid(const ExchangeCommand& command) {
  if (command.from.extension() != kMovingAi)
    return load_map_server(command.from, command.allow_outside ? PictureFolder::any : PictureFolder::own);
  return parse_moving_ai_map(exchange::text_of_file(command.from), command.from.string(),
                             command.cell_m.value_or(kMovingAiCell_m));
}

int import_grid(const ExchangeCommand& command, const CommonOptions& common) {
  ImportedGrid imported = read_grid(command);
  SavedMap map;
  map.grid = std::move(imported.grid);
  map.properties["imported_from"] = command.from.filename().string();
  save_map(command.to, map);
  const CellBox box = map.grid.bounds();
  tell_people(fmt::format("wrote {}: {} x {} cells of {:g} m, {:.1f} % of them known; no robot came with them: `cairn "
                          "plan` takes one of {:g} m radius unless it is told --radius-m",
                          command.to.string(), box.width(), box.height(), map.grid.cell_m(),
                          100.0 * known_ratio(map.grid), RobotModel{}.radius_m),
              imported.warnings, common);
  if (common.json)
    tell_json({{"map", command.to.string()},
               {"size_cells", {box.width(), box.height()}},
               {"cell_m", map.grid.cell_m()},
               {"landmarks", 0},
               {"routes", 0},
               {"warnings", imported.warnings}});
  return kExitDone;
}

}  // namespace

int map_import(const ExchangeCommand& command, const CommonOptions& common) {
  const std::string extension = command.from.extension().string();
  const std::optional<GraphFormat> format = graph_format_of(command.from);
  if (!format && std::ranges::find(kGridExtensions, extension) == kGridExtensions.end()) {
    std::vector<std::string> known = graph_extensions();
    known.insert(known.end(), kGridExtensions.begin(), kGridExtensions.end());
    fail_extension(command.from, "imported", known);
  }
  if (command.cell_m && extension != kMovingAi)
    throw std::runtime_error("map import: --cell-m is for Moving AI grids (*.map); " + command.from.string() +
                             " says itself how large it is");
  return format ? import_graph(command, *format, common) : import_grid(command, common);
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
    ExportedGraph exported = graph_text_of(map.graph, *format);
    write_file(command.to, exported.text);
    warnings = about(command.to, std::move(exported.warnings));
  }
  tell_people("wrote " + command.to.string(), warnings, common);
  if (common.json)
    tell_json({{"file", command.to.string()},
               {"landmarks", map.graph.landmarks().size()},
               {"routes", map.graph.routes().size()},
               {"warnings", warnings}});
  return kExitDone;
}

}  // namespace cairn
