#include "framework/program/view/map_view.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/program/mission/clusters_json.hpp"

namespace cairn {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kMaxViewBytes = std::int64_t{1} << 24;  // of one level
constexpr int kMinLevels = 4;

int levelled(int cells, int level) {
  return (cells + level - 1) / level;
}

std::string text_of_json(const Json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Json points_of(const std::vector<Pose2>& trajectory) {
  Json points = Json::array();
  for (const Pose2& pose : trajectory) points.push_back({pose.position().x(), pose.position().y()});
  return points;
}

// Of each category, in how many matchings it fitted there, and with what degree in the mean.
Json evidence_of(const Landmark& landmark) {
  Json evidence = Json::array();
  for (const CategoryEvidence& one : landmark.evidence)
    evidence.push_back({one.category, one.matchings, one.mean_degree});
  return evidence;
}

}  // namespace

std::vector<int> view_levels(const OccupancyGrid& grid) {
  std::vector<int> levels;
  if (grid.bounds().empty()) return levels;
  for (int level = 1; levels.size() < kMinLevels; level *= 2)
    if (std::int64_t{levelled(grid.bounds().width(), level)} * levelled(grid.bounds().height(), level) <= kMaxViewBytes)
      levels.push_back(level);
  return levels;
}

std::string view_cells(const OccupancyGrid& grid, int level) {
  const CellBox box = grid.bounds();
  const int width = levelled(box.width(), level);
  const int height = levelled(box.height(), level);
  std::vector<std::uint8_t> cells(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kUnknownOl);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(box.width()));
  for (int y = box.min.y; y < box.max.y; ++y) {
    grid.copy_ol({{box.min.x, y}, {box.max.x, y + 1}}, row);
    const std::size_t begin = static_cast<std::size_t>((y - box.min.y) / level) * static_cast<std::size_t>(width);
    for (std::size_t x = 0; x < row.size(); ++x) {
      std::uint8_t& cell = cells[begin + x / static_cast<std::size_t>(level)];
      if (row[x] == kUnknownOl) continue;
      cell = cell == kUnknownOl ? row[x] : std::max(cell, row[x]);
    }
  }
  return {cells.begin(), cells.end()};
}

std::string view_map_json(const SavedMap& map, const OccupancyGrid& grid, const std::string& name) {
  const CellBox box = grid.bounds();
  return text_of_json({{"name", name},
                       {"cell_m", grid.cell_m()},
                       {"origin_m", {grid.origin_m().x(), grid.origin_m().y()}},
                       {"box", {{"x", box.min.x}, {"y", box.min.y}, {"width", box.width()}, {"height", box.height()}}},
                       {"levels", view_levels(grid)},
                       {"driven_path", points_of(map.driven_path)}});
}

std::string view_landmarks_json(const LandmarkGraph& graph) {
  Json landmarks = Json::array();
  for (const auto& [id, landmark] : graph.landmarks()) {
    const Point at = landmark.T_map_landmark.position();
    landmarks.push_back({{"id", id},
                         {"label", label_of(landmark)},
                         {"category", landmark.category},
                         {"x", at.x()},
                         {"y", at.y()},
                         {"degree", landmark.degree},
                         {"sightings", landmark.sightings},
                         {"evidence", evidence_of(landmark)}});
  }
  return text_of_json(landmarks);
}

std::string view_routes_json(const LandmarkGraph& graph) {
  Json routes = Json::array();
  for (const auto& [id, route] : graph.routes()) {
    Json points = points_of(route.trajectory);
    if (points.empty())
      points = points_of({graph.find(route.from)->approach_pose(), graph.find(route.to)->approach_pose()});
    routes.push_back({{"id", id},
                      {"from", route.from},
                      {"to", route.to},
                      {"cost_m", route.cost_m},
                      {"driven", route.driven},
                      {"closed", route.closed},
                      {"points", points}});
  }
  return text_of_json(routes);
}

std::string view_clusters_json(const ClusterTree& tree, const LandmarkGraph& graph) {
  return text_of_json(json_of(listed(tree, graph)));
}

}  // namespace cairn
