#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>

#include "framework/contracts/robot_model.hpp"
#include "framework/files/map_server_file.hpp"
#include "framework/files/rmf_file.hpp"
#include "framework/planning/clusters_config.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "framework/program/map/exchange_report.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/exchange/graphs/graph_file.hpp"
#include "maps/exchange/grids/moving_ai_map.hpp"
#include "maps/hierarchy/hierarchy.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kMovingAi = ".map";
constexpr std::array<std::string_view, 2> kYaml{".yaml", ".yml"};
constexpr std::array<std::string_view, 3> kPictures{".png", ".pgm", ".bmp"};
constexpr double kMovingAiCell_m = 1.0;

bool is_one_of(std::string_view extension, std::span<const std::string_view> known) {
  return std::ranges::find(known, extension) != known.end();
}

ClustersConfig clusters_of(const ExchangeCommand& command) {
  ConfigValue settings;
  settings.kind = ConfigValue::Kind::map;
  settings.place.file = "--clusters";
  for (const std::string& assignment : command.clusters) apply_override(settings, assignment, "--clusters");
  return load_config<ClustersConfig>(settings, "--clusters");
}

int import_graph(const ExchangeCommand& command, ImportedGraph imported, const CommonOptions& common) {
  SavedMap map;
  map.graph = std::move(imported.graph);
  map.properties = imported.properties;
  const ClustersConfig clusters = clusters_of(command);
  map.clusters = cluster_landmarks(map.graph, {}, {clusters.sizes(), {}});
  if (!command.clusters.empty()) map.properties[kClustersProperty] = text_of(clusters);
  map.properties["imported_from"] = command.from.filename().string();
  save_map(command.to, map, Links::replace);
  const std::vector<std::string> warnings = about(command.from, std::move(imported.warnings));
  const std::size_t landmarks = map.graph.landmarks().size();
  const std::size_t routes = map.graph.routes().size();
  print_report(
      {{"map", command.to.string()}, {"landmarks", landmarks}, {"routes", routes}, {"warnings", warnings}},
      fmt::format("wrote {}: {}, {}", command.to.string(), counted(landmarks, "landmark"), counted(routes, "route")),
      warnings, common);
  return kExitDone;
}

// A picture alone says nothing of its scale; else it means what map_server's default settings say.
ImportedGrid read_picture(const ExchangeCommand& command) {
  const std::string name = command.from.string();
  if (!command.cell_m)
    throw std::runtime_error("map import: " + name +
                             " is a picture: --cell-m must give the side of a pixel in metres; 0.05 is usual");
  MapServerSettings settings;
  settings.resolution_m = *command.cell_m;
  ImportedGrid imported = grid_of(parse_grey_picture(exchange::text_of_file(command.from), name), settings, name);
  imported.warnings = about(command.from, std::move(imported.warnings));
  return imported;
}

ImportedGrid read_grid(const ExchangeCommand& command, const std::string& extension) {
  if (is_one_of(extension, kPictures)) return read_picture(command);
  if (extension != kMovingAi)
    return load_map_server(command.from, command.allow_outside ? PictureFolder::any : PictureFolder::own);
  return parse_moving_ai_map(exchange::text_of_file(command.from), command.from.string(),
                             command.cell_m.value_or(kMovingAiCell_m));
}

int import_grid(const ExchangeCommand& command, const std::string& extension, const CommonOptions& common) {
  ImportedGrid imported = read_grid(command, extension);
  SavedMap map;
  map.grid = std::move(imported.grid);
  map.properties["imported_from"] = command.from.filename().string();
  save_map(command.to, map, Links::replace);
  const CellBox box = map.grid.bounds();
  print_report(
      {{"map", command.to.string()},
       {"size_cells", {box.width(), box.height()}},
       {"cell_m", map.grid.cell_m()},
       {"landmarks", 0},
       {"routes", 0},
       {"warnings", imported.warnings}},
      fmt::format("wrote {}: {} x {} cells of {:g} m, {:.1f} % known within its outermost walls; no robot came "
                  "with them: `cairn "
                  "plan` takes one of {:g} m radius unless --radius-m is given",
                  command.to.string(), box.width(), box.height(), map.grid.cell_m(), 100.0 * known_ratio(map.grid),
                  RobotModel{}.radius_m),
      imported.warnings, common);
  return kExitDone;
}

}  // namespace

int map_import(const ExchangeCommand& command, const CommonOptions& common) {
  const std::string extension = extension_of(command.from);
  const std::optional<GraphFormat> format = graph_format_of(command.from);
  const bool is_yaml = is_one_of(extension, kYaml);
  const bool has_own_scale = is_yaml || format.has_value();
  if (!has_own_scale && extension != kMovingAi && !is_one_of(extension, kPictures)) {
    std::vector<std::string> known = graph_extensions(GraphUse::read);
    known.emplace_back(kMovingAi);
    known.insert(known.end(), kYaml.begin(), kYaml.end());
    known.insert(known.end(), kPictures.begin(), kPictures.end());
    fail_extension(command.from, "imported", known);
  }
  if (command.cell_m && has_own_scale)
    throw std::runtime_error("map import: --cell-m is for Moving AI grids (*.map) and pictures; " +
                             command.from.string() + " says itself how large it is");
  if (format) return import_graph(command, read_graph_file(command.from, *format), common);
  if (is_yaml) {
    const ConfigValue root = parse_config_text(exchange::text_of_file(command.from), command.from.string());
    if (is_rmf(root)) return import_graph(command, rmf_graph_of(root), common);
  }
  return import_grid(command, extension, common);
}

}  // namespace cairn
