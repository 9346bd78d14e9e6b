#include <algorithm>
#include <charconv>

#include "maps/base/deflate.hpp"
#include "maps/base/source_text.hpp"
#include "maps/store/tables/codec.hpp"
#include "maps/store/tables/tables.hpp"
#include "maps/store/tables/trajectory.hpp"

namespace cairn::store {
namespace {

int tile_index(int cell) {
  return cell >> 6;
}

void write_grid(Database& database, const OccupancyGrid& grid) {
  const CellBox box = grid.bounds().empty() ? CellBox{} : grid.bounds();
  Statement(database, "INSERT INTO grid VALUES (0, ?, ?, ?, ?, ?, ?, ?, ?)")
      .bind(grid.cell_m())
      .bind(grid.origin_m().x())
      .bind(grid.origin_m().y())
      .bind(grid.clamp_nat())
      .bind(box.min.x)
      .bind(box.min.y)
      .bind(box.max.x)
      .bind(box.max.y)
      .run();
}

void write_tiles(Database& database, const OccupancyGrid& grid) {
  const CellBox box = grid.bounds();
  if (box.empty()) return;
  Statement insert(database, "INSERT INTO tiles VALUES (0, ?, ?, ?, ?)");
  std::vector<LogOdds> cells(OccupancyGrid::kTileSide * OccupancyGrid::kTileSide);
  for (int ty = tile_index(box.min.y); ty <= tile_index(box.max.y - 1); ++ty) {
    for (int tx = tile_index(box.min.x); tx <= tile_index(box.max.x - 1); ++tx) {
      grid.copy_log_odds({{tx * OccupancyGrid::kTileSide, ty * OccupancyGrid::kTileSide},
                          {(tx + 1) * OccupancyGrid::kTileSide, (ty + 1) * OccupancyGrid::kTileSide}},
                         cells);
      if (std::ranges::all_of(cells, [](LogOdds value) { return value == 0; })) continue;
      std::string raw;
      for (const LogOdds value : cells) append_little_endian(raw, value);
      insert.bind(ty).bind(tx).bind_blob(deflated(raw));
      insert.bind(crc32_of(raw)).run();
    }
  }
}

// The columns that landmarks and retired ones begin with.
void bind_landmark(Statement& insert, const Landmark& landmark) {
  insert.bind(landmark.id).bind(landmark.level).bind_text(landmark.name).bind_text(landmark.category);
  insert.bind(landmark.T_map_landmark).bind(landmark.degree).bind(landmark.sightings).bind(landmark.access);
}

// prefix: of the tables, "landmark" or "candidate".
void write_history(Database& database, const std::string& prefix, const Landmark& landmark) {
  if (landmark.templates.empty() && landmark.evidence.empty()) return;
  Statement insert_template(database, "INSERT INTO " + prefix + "_templates VALUES (?, ?, ?, ?, ?)");
  std::int64_t rank = 0;
  for (const auto& [category, orientation_rad, degree] : landmark.templates)
    insert_template.bind(landmark.id).bind(++rank).bind_text(category).bind(orientation_rad).bind(degree).run();
  Statement insert(database, "INSERT INTO " + prefix + "_evidence VALUES (?, ?, ?, ?, ?, ?)");
  for (const auto& [category, matchings, mean_degree, best_degree, last_degree] : landmark.evidence) {
    insert.bind(landmark.id).bind_text(category).bind(matchings);
    insert.bind(mean_degree).bind(best_degree).bind(last_degree).run();
  }
}

void write_landmarks(Database& database, const std::string& prefix, const LandmarkGraph& graph) {
  Statement insert(database, "INSERT INTO " + prefix + "s VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (const auto& [id, landmark] : graph.landmarks()) {
    bind_landmark(insert, landmark);
    insert.bind_text(landmark.annotations).run();
    write_history(database, prefix, landmark);
  }
}

void write_retired_landmarks(Database& database, const LandmarkGraph& graph) {
  Statement insert(database, "INSERT INTO retired_landmarks VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (const auto& [id, retired] : graph.retired()) {
    bind_landmark(insert, retired.landmark);
    insert.bind_text(retired.reason).bind_text(retired.landmark.annotations).run();
    write_history(database, "landmark", retired.landmark);
  }
}

// Of landmarks and retired ones; a map of version 1 has no such table.
void write_markers(Database& database, const LandmarkGraph& graph) {
  if (!has_markers(graph)) return;
  Statement insert(database, "INSERT INTO landmark_markers VALUES (?, ?, ?)");
  const auto write = [&](const Landmark& landmark) {
    if (!landmark.marker) return;
    insert.bind(landmark.id).bind_text(std::string(name_of(landmark.marker->family)));
    insert.bind(landmark.marker->number).run();
  };
  for (const auto& [id, landmark] : graph.landmarks()) write(landmark);
  for (const auto& [id, retired] : graph.retired()) write(retired.landmark);
}

void write_routes(Database& database, const LandmarkGraph& graph) {
  Statement insert(database, "INSERT INTO routes VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (const auto& [id, route] : graph.routes()) {
    const std::string packed = packed_trajectory(route.trajectory);
    insert.bind(id).bind(route.level).bind(route.from).bind(route.to).bind(route.cost_m);
    insert.bind(route.driven).bind(route.closed).bind(route.trajectory.size()).bind_blob(packed).bind(crc32_of(packed));
    insert.bind(route.speed_limit_mps).bind_text(route.annotations).run();
  }
}

void write_clusters(Database& database, const ClusterTree& tree) {
  Statement insert(database, "INSERT INTO clusters VALUES (?, ?, ?, ?, ?)");
  for (const auto& [id, cluster] : tree.clusters) {
    insert.bind(id).bind(cluster.level).bind(cluster.parent).bind(cluster.anchor);
    insert.bind_text(cluster.name).run();
  }
  Statement insert_member(database, "INSERT INTO landmark_clusters VALUES (?, ?)");
  for (const auto& [landmark, cluster] : tree.cluster_of) insert_member.bind(landmark).bind(cluster).run();
}

void write_next_ids(Database& database, const SavedMap& map) {
  Statement next(database, "INSERT INTO next_ids VALUES (?, ?)");
  const LandmarkId next_candidate = map.progress ? map.progress->candidates.next_landmark_id() : 1;
  next.bind_text("candidate").bind(next_candidate).run();
  next.bind_text("cluster").bind(map.clusters.next_id).run();
  next.bind_text("landmark").bind(map.graph.next_landmark_id()).run();
  next.bind_text("route").bind(map.graph.next_route_id()).run();
}

// "diameter", or "x,y x,y ..." with ";" between polygons.
std::string parameters_of(const Contour& contour) {
  if (contour.is_circle()) return exchange::number_text(contour.circle_diameter_m);
  std::string parameters;
  for (const std::vector<Point>& corners : contour.polygons_m) {
    if (!parameters.empty()) parameters += ';';
    for (const Point& corner : corners) {
      if (&corner != &corners.front()) parameters += ' ';
      parameters += exchange::number_text(corner.x()) + ',' + exchange::number_text(corner.y());
    }
  }
  return parameters;
}

void write_shapes(Database& database, const std::vector<LandmarkShape>& shapes) {
  Statement insert(database, "INSERT INTO shapes VALUES (?, ?, ?, ?)");
  std::int64_t number = 0;
  for (const LandmarkShape& shape : shapes) {
    const Contour& contour = shape.contour;
    const char* const kind = contour.is_circle() ? "circle" : contour.polygons_m.size() == 1 ? "polygon" : "polygons";
    insert.bind(++number).bind_text(shape.category).bind_text(kind).bind_text(parameters_of(contour)).run();
  }
}

void write_driven_path(Database& database, const std::vector<Pose2>& path) {
  Statement insert(database, "INSERT INTO driven_path VALUES (?, ?, ?, ?)");
  std::int64_t number = 0;
  for (const Pose2& pose : path) insert.bind(++number).bind(pose).run();
}

void write_progress(Database& database, const MissionProgress& progress) {
  Statement insert(database, "INSERT INTO progress VALUES (0, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(progress.time_s).bind(progress.step).bind_text(progress.step_name);
  insert.bind(progress.T_map_robot).bind(progress.true_T_map_robot);
  insert.bind(progress.distance_m).bind(progress.readings).bind(progress.matchings).bind(progress.collisions).run();
  write_landmarks(database, "candidate", progress.candidates);
}

}  // namespace

bool has_markers(const LandmarkGraph& graph) {
  return std::ranges::any_of(graph.landmarks(), [](const auto& entry) { return entry.second.marker.has_value(); }) ||
         std::ranges::any_of(graph.retired(),
                             [](const auto& entry) { return entry.second.landmark.marker.has_value(); });
}

void write_content(Database& database, const SavedMap& map) {
  Statement insert(database, "INSERT INTO meta VALUES (?, ?)");
  for (const auto& [key, value] : map.properties) insert.bind_text(key).bind_text(value).run();
  write_grid(database, map.grid);
  write_tiles(database, map.grid);
  write_landmarks(database, "landmark", map.graph);
  write_retired_landmarks(database, map.graph);
  write_markers(database, map.graph);
  write_routes(database, map.graph);
  write_clusters(database, map.clusters);
  write_next_ids(database, map);
  write_shapes(database, map.shapes);
  write_driven_path(database, map.driven_path);
  if (map.progress) write_progress(database, *map.progress);
  if (!map.submaps.empty()) write_submaps(database, map.submaps);
}

}  // namespace cairn::store
