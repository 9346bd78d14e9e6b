#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/output_files.hpp"
#include "framework/program/common/print.hpp"
#include "framework/program/run/pictures.hpp"
#include "maps/base/printable.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"
#include "maps/clustering/cluster_levels.hpp"
#include "maps/clustering/cluster_tree.hpp"
#include "maps/landmarks/close_categories.hpp"
#include "maps/landmarks/joined_landmarks.hpp"
#include "maps/landmarks/route_count.hpp"
#include "maps/store/repair.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMaxListed = 50;

// At most twelve of them.
std::string text_of_first(const std::vector<LandmarkId>& landmarks) {
  constexpr std::size_t kMost = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(landmarks.size(), kMost); ++i) text += fmt::format(" L{}", landmarks[i]);
  return landmarks.size() > kMost ? text + " ..." : text;
}

ordered_json clusters_json(const SavedMap& map) {
  ordered_json clusters = ordered_json::array();
  for (const auto& [id, cluster] : map.clusters.clusters) {
    ordered_json members = ordered_json::array();
    for (const LandmarkId landmark : members_of(map.clusters, id)) members.push_back(fmt::format("L{}", landmark));
    clusters.push_back({{"id", fmt::format("C{}:L{}", cluster.level, cluster.anchor)},
                        {"name", cluster.name},
                        {"level", cluster.level},
                        {"landmarks", std::move(members)}});
  }
  return clusters;
}

ordered_json levels_json(const SavedMap& map) {
  ordered_json levels = ordered_json::array();
  for (const auto& [clusters, boundary] : levels_of(map.clusters, map.graph))
    levels.push_back({{"clusters", clusters}, {"boundary", boundary}});
  return levels;
}

// Landmarks whose category has won by a hair.
ordered_json close_json(const LandmarkGraph& graph) {
  ordered_json list = ordered_json::array();
  for (const auto& [id, landmark] : graph.landmarks())
    if (const auto close = close_categories(landmark))
      list.push_back({{"id", fmt::format("L{}", id)},
                      {"category", close->category},
                      {"degree", close->degree},
                      {"other", close->other},
                      {"other_degree", close->other_degree}});
  return list;
}

// Sets of landmarks that open routes join, whichever their direction.
std::size_t components_of(const LandmarkGraph& graph) {
  JoinedLandmarks joined = joined_by_routes(graph);
  std::set<LandmarkId> sets;
  for (const auto& [id, landmark] : graph.landmarks()) sets.insert(joined.set_of(id));
  return sets.size();
}

// The first of them, and how many more there are.
template <class Things, class Text>
void list_first(const Things& things, const char* what, Text text_of) {
  std::size_t shown = 0;
  for (const auto& [id, thing] : things) {
    if (shown++ == kMaxListed) break;
    std::cout << text_of(thing);
  }
  if (things.size() > kMaxListed) std::cout << fmt::format("  ... and {} more {}\n", things.size() - kMaxListed, what);
}

ordered_json json_of(const std::optional<MissionProgress>& progress) {
  if (!progress) return nullptr;
  return {{"time_s", progress->time_s}, {"step", progress->step + 1}, {"step_name", progress->step_name}};
}

ordered_json json_of(const SavedMap& map, int schema) {
  const CellBox bounds = map.grid.bounds();
  const double cell_m = map.grid.cell_m();
  const Point corner = map.grid.origin_m() + cell_m * Point(bounds.min.x, bounds.min.y);
  const SubmapCounts submaps = counts_of(map.submaps);
  return {{"schema", schema},
          {"cell_m", cell_m},
          {"size_cells", {bounds.width(), bounds.height()}},
          {"origin_m", {corner.x(), corner.y()}},
          {"landmarks", map.graph.landmarks().size()},
          {"routes", map.graph.routes().size()},
          {"components", components_of(map.graph)},
          {"submaps", submaps.submaps},
          {"submap_nodes", submaps.nodes},
          {"submap_edges", submaps.edges},
          {"submap_closures", submaps.closures},
          {"submap_closures_believed", submaps.closures_believed},
          {"close_categories", close_json(map.graph)},
          {"levels", levels_json(map)},
          {"clusters", clusters_json(map)},
          {"explored_ratio", known_ratio(map.grid)},
          {"progress", json_of(map.progress)}};
}

std::string text_of_grid(const OccupancyGrid& grid) {
  const CellBox bounds = grid.bounds();
  if (bounds.empty()) return "no grid";
  return fmt::format("{:.2f} x {:.2f} m in cells of {:g} m, {:.1f} % known within its outermost walls",
                     bounds.width() * grid.cell_m(), bounds.height() * grid.cell_m(), grid.cell_m(),
                     100.0 * known_ratio(grid));
}

}  // namespace

int map_info(const MapCommand& command, const CommonOptions& common) {
  const SavedMap map = load_map(command.map);
  const int schema = schema_version_of(command.map);
  if (common.json) {
    print_json(json_of(map, schema));
    return kExitDone;
  }
  std::cout << fmt::format("{}: schema {}, {}\n", command.map.string(), schema, text_of_grid(map.grid));
  for (const auto& [key, value] : map.properties)
    std::cout << "  " << printable(key) << ": " << printable(value) << "\n";
  if (map.progress)
    std::cout << fmt::format("  saved {:.1f} s after the mission began, {}\n", map.progress->time_s,
                             map.progress->step_name.empty() ? "all steps done"
                                                             : fmt::format("at step {}: {}", map.progress->step + 1,
                                                                           printable(map.progress->step_name)));
  std::cout << "  " << counted(map.graph.landmarks().size(), "landmark") << ", " << counted_routes(map.graph) << "\n";
  if (!map.graph.landmarks().empty())
    std::cout << fmt::format("  {} by open routes\n", counted(components_of(map.graph), "component"));
  if (const KeptSubmaps& kept = map.submaps; !kept.empty())
    std::cout << fmt::format("  {}, {} and {} of their pose graph\n", counted(kept.submaps.size(), "submap"),
                             counted(kept.nodes.size(), "node"), counted(kept.edges.size(), "edge"));
  int level = 0;
  for (const auto& [clusters, boundary] : levels_of(map.clusters, map.graph))
    std::cout << fmt::format("  level {}: {}, {} on their boundaries\n", ++level, counted(clusters, "cluster"),
                             counted(boundary, "landmark"));
  list_first(map.graph.landmarks(), "landmarks", [](const Landmark& landmark) {
    const std::string marker = landmark.marker ? ", " + text_of(*landmark.marker) : "";
    const std::string name = marker + (landmark.name.empty() ? "" : ", " + in_quotes(landmark.name));
    return fmt::format("  L{:<5} {:<12} at ({:.2f}, {:.2f}), {} deg, degree {}{}\n", landmark.id,
                       printable(landmark.category), landmark.T_map_landmark.x_m, landmark.T_map_landmark.y_m,
                       std::lround(degrees(landmark.T_map_landmark.theta_rad)), printable(degree_text(landmark)), name);
  });
  list_first(map.clusters.clusters, "clusters", [&](const Cluster& cluster) {
    const std::vector<LandmarkId> members = members_of(map.clusters, cluster.id);
    return fmt::format("  C{}:L{}{}, {}:{}\n", cluster.level, cluster.anchor,
                       cluster.name.empty() ? "" : " " + printable(cluster.name), counted(members.size(), "landmark"),
                       text_of_first(members));
  });
  list_first(map.graph.routes(), "routes", [](const Route& route) {
    return fmt::format("  route {:<3} L{} -> L{}, {:.2f} m, {}{}\n", route.id, route.from, route.to, route.cost_m,
                       route.driven ? "driven" : "planned", route.closed ? ", closed" : "");
  });
  return kExitDone;
}

int map_render(const MapCommand& command, const CommonOptions& common) {
  const std::filesystem::path picture = file_to_write(command.picture, "map.png");
  draw_saved_map(picture, load_map(command.map), command.map.filename().string());
  print({{"picture", picture.string()}}, "wrote " + picture.string() + "\n", common);
  return kExitDone;
}

}  // namespace cairn
