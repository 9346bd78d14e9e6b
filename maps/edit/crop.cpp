#include "maps/edit/crop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/hierarchy/hierarchy.hpp"

namespace cairn {
namespace {

struct Box {
  Point min_m;
  Point max_m;

  [[nodiscard]] bool contains(const Point& p) const {
    return (p.array() >= min_m.array()).all() && (p.array() <= max_m.array()).all();
  }
};

std::string text_of(const Box& box) {
  using exchange::number_text;
  return fmt::format("{},{} to {},{}", number_text(box.min_m.x()), number_text(box.min_m.y()),
                     number_text(box.max_m.x()), number_text(box.max_m.y()));
}

void include(std::optional<Box>& all, const Point& p) {
  all = all ? Box{all->min_m.cwiseMin(p), all->max_m.cwiseMax(p)} : Box{p, p};
}

std::optional<Box> extent_of(const SavedMap& map) {
  std::optional<Box> extent;
  const CellBox cells = map.grid.bounds();
  if (!cells.empty())
    for (const Cell corner : {cells.min, cells.max})
      include(extent, map.grid.origin_m() + map.grid.cell_m() * Point(corner.x, corner.y));
  for (const auto& [id, landmark] : map.graph.landmarks()) include(extent, landmark.T_map_landmark.position());
  return extent;
}

OccupancyGrid cropped_grid(const OccupancyGrid& grid, const Box& box) {
  constexpr double kRounding = 1e-9;  // of a cell
  const auto nearest_edge = [&](const Point& p, double bias) {
    const double half = grid.cell_m() * (0.5 + bias);
    return grid.cell_at(p + Point(half, half));
  };
  // A cell is inside when its centre is.
  return part_of(grid, {nearest_edge(box.min_m, -kRounding), nearest_edge(box.max_m, kRounding)});
}

bool stays(const Route& route, const LandmarkGraph& kept, const Box& box) {
  return kept.find(route.from) != nullptr && kept.find(route.to) != nullptr &&
         std::ranges::all_of(route.trajectory, [&](const Pose2& pose) { return box.contains(pose.position()); });
}

}  // namespace

CroppedMap crop_map(const SavedMap& map, const Point& corner_m, const Point& opposite_m) {
  const Box box{corner_m.cwiseMin(opposite_m), corner_m.cwiseMax(opposite_m)};
  if (!corner_m.allFinite() || !opposite_m.allFinite() || !((box.max_m - box.min_m).minCoeff() > 0.0))
    throw std::invalid_argument("a box needs two finite corners and some width and height");
  CroppedMap cropped{map, 0, 0, {}};
  cropped.map.grid = cropped_grid(map.grid, box);
  LandmarkGraph& graph = cropped.map.graph = {};
  std::size_t accesses = 0;
  for (const auto& [id, landmark] : map.graph.landmarks()) {
    if (!box.contains(landmark.T_map_landmark.position())) continue;
    Landmark kept = landmark;
    if (kept.access && !box.contains(kept.access->position())) {
      kept.access.reset();
      ++accesses;
    }
    graph.add(std::move(kept));
  }
  for (const auto& [id, route] : map.graph.routes())
    if (stays(route, graph, box)) graph.add_route(route);
  for (const auto& [id, retired] : map.graph.retired())
    if (box.contains(retired.landmark.T_map_landmark.position())) graph.add_retired(retired);
  graph.reserve_ids(map.graph.next_landmark_id(), map.graph.next_route_id());
  if (cropped.map.grid.bounds().empty() && graph.landmarks().empty()) {
    const std::optional<Box> extent = extent_of(map);
    throw std::invalid_argument("nothing of the map lies in the box " + text_of(box) +
                                (extent ? "; the map reaches from " + text_of(*extent) : "; the map is empty"));
  }
  std::erase_if(cropped.map.driven_path, [&](const Pose2& pose) { return !box.contains(pose.position()); });
  if (!cropped.map.submaps.empty()) cropped.warnings.emplace_back("the submaps show what is cut off: they are dropped");
  cropped.map.submaps = {};
  if (cropped.map.progress)
    cropped.warnings.emplace_back("no mission can resume from a part of its map: its progress is dropped");
  cropped.map.progress.reset();
  const ClusterSizes sizes;
  cropped.map.clusters =
      cluster_landmarks(graph, {}, {sizes, passages_in(cropped.map.grid, graph, sizes.narrow_below_m)});
  cropped.landmarks_dropped = map.graph.landmarks().size() - graph.landmarks().size();
  cropped.routes_dropped = map.graph.routes().size() - graph.routes().size();
  const auto named = static_cast<std::size_t>(
      std::ranges::count_if(map.clusters.clusters, [](const auto& entry) { return !entry.second.name.empty(); }));
  if (accesses > 0)
    cropped.warnings.push_back(counted(accesses, "landmark") +
                               ": where a robot stands at it lies outside and is forgotten");
  if (named > 0) cropped.warnings.push_back(counted(named, "cluster") + ": made anew, the name is lost");
  return cropped;
}

}  // namespace cairn
