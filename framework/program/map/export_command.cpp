#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "framework/program/common/output_files.hpp"
#include "framework/program/common/print.hpp"
#include "framework/program/common/refusal.hpp"
#include "framework/program/map/exchange_report.hpp"
#include "framework/program/run/pictures.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/exchange/graphs/graph_file.hpp"
#include "maps/exchange/graphs/rmf_nav_graph.hpp"
#include "maps/exchange/grids/grey_picture_write.hpp"
#include "maps/exchange/grids/grid_picture.hpp"
#include "maps/exchange/grids/map_server_write.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kPicture = ".png";
constexpr std::array<std::string_view, 2> kMapServer{".yaml", ".yml"};

struct Written {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> warnings;
};

[[noreturn]] void fail_option(const char* option, const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error("map export: " + std::string(option) + " is " + why + "; the file to write is " +
                           file.string());
}

const OccupancyGrid& grid_of(const SavedMap& map, const ExchangeCommand& command, const std::string& instead) {
  if (map.grid.bounds().empty()) throw std::runtime_error(command.from.string() + ": holds no grid; " + instead);
  return map.grid;
}

MapServerMode mode_of(const std::string& name) {
  return name == "raw" ? MapServerMode::raw : name == "scale" ? MapServerMode::scale : MapServerMode::trinary;
}

PictureFormat picture_format_of(const std::string& name) {
  return name == "png" ? PictureFormat::png : name == "bmp" ? PictureFormat::bmp : PictureFormat::pgm;
}

// What a grid's file leaves away of the map.
void warn_of_graph(const LandmarkGraph& graph, std::vector<std::string>& warnings) {
  if (graph.landmarks().empty()) return;
  warnings.push_back(counted(graph.landmarks().size(), "landmark") + ", " + counted(graph.routes().size(), "route") +
                     ": not written, the file holds the grid only");
}

Written write_map_server(const ExchangeCommand& command, const SavedMap& map) {
  const MapServerMode mode = mode_of(command.mode);
  const std::string format = !command.picture.empty() ? command.picture : mode == MapServerMode::scale ? "png" : "pgm";
  const std::filesystem::path picture = std::filesystem::path(command.to).replace_extension(format);
  std::error_code error;
  if (std::filesystem::equivalent(picture, command.from, error))
    throw std::runtime_error("map export: the picture " + picture.string() +
                             " would overwrite the map that is exported; give -o another name");
  ExportedGrid exported =
      map_server_of(grid_of(map, command, "map_server files are of grids, *.nav.yaml of landmarks and routes"), mode);
  if (mode == MapServerMode::scale && format == "pgm") {
    exported.picture.alpha.clear();
    exported.warnings.emplace_back(
        "PGM holds no transparency: unknown cells are written as grey 128, which readers take for 50 %; "
        "--picture png keeps them unknown");
  }
  warn_of_graph(map.graph, exported.warnings);
  const bool is_new = !std::filesystem::exists(picture, error);
  write_file(picture, picture_text_of(exported.picture, picture_format_of(format)));
  try {
    write_file(command.to, map_server_yaml_of(exported.settings, picture.filename().string()));
  } catch (...) {
    if (is_new) std::filesystem::remove(picture, error);  // half of a pair is of no use
    throw;
  }
  return {{command.to, picture}, exported.warnings};
}

Written write_scaled(const ExchangeCommand& command, const SavedMap& map) {
  const OccupancyGrid& grid = grid_of(map, command, "without --scale its landmarks and routes are drawn");
  Written written{{command.to}, {}};
  const GreyPicture picture = refused_about("map export", [&] { return grid_picture_of(grid, *command.px_per_cell); });
  warn_of_graph(map.graph, written.warnings);
  write_file(command.to, picture_text_of(picture, PictureFormat::png));
  return written;
}

// "x.nav.yaml"
bool is_nav_graph(const std::filesystem::path& file) {
  return file.extension() == kMapServer[0] && file.stem().extension() == ".nav";
}

// No format of other tools holds clusters.
void warn_of_cluster_names(const ClusterTree& clusters, std::vector<std::string>& warnings) {
  const auto named =
      std::ranges::count_if(clusters.clusters, [](const auto& entry) { return !entry.second.name.empty(); });
  if (named > 0) warnings.push_back(counted(named, "name") + " of clusters: not written");
}

Written write_nav_graph(const ExchangeCommand& command, const SavedMap& map) {
  if (map.graph.landmarks().empty())
    throw std::runtime_error(command.from.string() + ": holds no landmark to make a vertex of");
  const auto site = map.properties.find("rmf");
  ExportedGraph exported = rmf_nav_graph_of(map.graph, site == map.properties.end() ? std::string() : site->second);
  warn_of_cluster_names(map.clusters, exported.warnings);
  write_file(command.to, exported.text);
  return {{command.to}, exported.warnings};
}

Written write_graph(const ExchangeCommand& command, const SavedMap& map, GraphFormat format) {
  ExportedGraph exported = graph_text_of(map.graph, format);
  warn_of_cluster_names(map.clusters, exported.warnings);
  write_file(command.to, exported.text);
  return {{command.to}, exported.warnings};
}

}  // namespace

int map_export(const ExchangeCommand& command, const CommonOptions& common) {
  const std::string extension = command.to.extension().string();
  const bool is_picture = extension == kPicture;
  const bool is_rmf = is_nav_graph(command.to);
  const bool is_map_server = !is_rmf && (extension == kMapServer[0] || extension == kMapServer[1]);
  const std::vector<std::string> written_graphs = graph_extensions(GraphUse::written);
  const bool is_graph = std::ranges::find(written_graphs, extension) != written_graphs.end();
  const std::optional<GraphFormat> format = is_graph ? graph_format_of(command.to) : std::nullopt;
  if (!format && !is_picture && !is_map_server && !is_rmf) {
    std::vector<std::string> known = written_graphs;
    known.emplace_back(kPicture);
    known.insert(known.end(), kMapServer.begin(), kMapServer.end());
    fail_extension(command.to, "exported to", known);
  }
  if (!is_map_server && !command.mode.empty()) fail_option("--mode", command.to, "for map_server files (*.yaml)");
  if (!is_map_server && !command.picture.empty()) fail_option("--picture", command.to, "for map_server files (*.yaml)");
  if (!is_picture && command.px_per_cell) fail_option("--scale", command.to, "for pictures (*.png)");
  const SavedMap map = load_map(command.from);
  Written written;
  if (is_rmf)
    written = write_nav_graph(command, map);
  else if (is_map_server)
    written = write_map_server(command, map);
  else if (command.px_per_cell)
    written = write_scaled(command, map);
  else if (is_picture)
    draw_saved_map(command.to, map, command.from.filename().string());
  else
    written = write_graph(command, map, *format);
  written.warnings = about(command.to, std::move(written.warnings));
  std::string names = command.to.string();
  for (std::size_t i = 1; i < written.files.size(); ++i) names += " and " + written.files[i].string();
  print_report({{"file", command.to.string()},
                {"landmarks", map.graph.landmarks().size()},
                {"routes", map.graph.routes().size()},
                {"warnings", written.warnings}},
               "wrote " + names, written.warnings, common);
  return kExitDone;
}

}  // namespace cairn
