#include "tests/bench/clusters/explored_site.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "maps/base/portable_random.hpp"
#include "maps/geometry/segments.hpp"
#include "maps/grid/travel_field.hpp"

namespace cairn {
namespace {

constexpr double kClearance_m = 0.22 + 0.05;
constexpr double kApart_m = 0.8;  // landmarks from each other, at least
constexpr std::size_t kRoutesPerLandmark = 3;

std::vector<Pose2> poses_along(const std::vector<Point>& path) {
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Point along = i + 1 < path.size() ? Point(path[i + 1] - path[i]) : Point(path[i] - path[i - 1]);
    poses.push_back({path[i].x(), path[i].y(), std::atan2(along.y(), along.x())});
  }
  return poses;
}

// Cells where the robot can stand, of the largest connected part.
std::vector<Cell> standing_cells(const FloorPlan& plan, const DistanceField& space) {
  std::vector<Cell> best;
  const auto index_of = [&](Cell cell) {
    return static_cast<std::size_t>(cell.y - plan.box.min.y) * static_cast<std::size_t>(plan.box.width()) +
           static_cast<std::size_t>(cell.x - plan.box.min.x);
  };
  std::vector<bool> seen(plan.room.size());
  const auto is_new = [&](Cell cell) {
    return plan.room_at(cell) >= 0 && !seen[index_of(cell)] && space.distance_m(cell) >= kClearance_m;
  };
  for (int y = plan.box.min.y; y < plan.box.max.y; ++y)
    for (int x = plan.box.min.x; x < plan.box.max.x; ++x) {
      if (!is_new({x, y})) continue;
      std::vector<Cell> part{{x, y}};
      seen[index_of({x, y})] = true;
      for (std::size_t at = 0; at < part.size(); ++at)
        for (const Cell step : {Cell{1, 0}, Cell{-1, 0}, Cell{0, 1}, Cell{0, -1}})
          if (const Cell next = part[at] + step; is_new(next)) {
            seen[index_of(next)] = true;
            part.push_back(next);
          }
      if (part.size() > best.size()) best = std::move(part);
    }
  return best;
}

void add_landmarks(ExploredSite& site, const FloorPlan& plan, const std::vector<Cell>& cells, int count,
                   PortableRandom& random) {
  std::vector<Point> placed;
  for (int tries = 0; tries < 50 * count && static_cast<int>(placed.size()) < count; ++tries) {
    const Cell cell = cells[static_cast<std::size_t>(random.whole(0, static_cast<int>(cells.size()) - 1))];
    const Point at = plan.grid.centre_of(cell);
    if (std::ranges::any_of(placed, [&](const Point& other) { return (other - at).norm() < kApart_m; })) continue;
    placed.push_back(at);
    Landmark landmark;
    landmark.category = "object";
    landmark.T_map_landmark = Pose2{at.x(), at.y(), 0.0};
    site.room_of.emplace(site.graph.add(landmark), plan.room_at(cell));
  }
}

std::set<std::pair<LandmarkId, LandmarkId>> nearest_pairs(const LandmarkGraph& graph) {
  std::set<std::pair<LandmarkId, LandmarkId>> pairs;
  for (const auto& [id, landmark] : graph.landmarks()) {
    std::vector<std::pair<double, LandmarkId>> others;
    for (const auto& [other, there] : graph.landmarks())
      if (other != id)
        others.emplace_back((there.T_map_landmark.position() - landmark.T_map_landmark.position()).norm(), other);
    std::ranges::sort(others);
    others.resize(std::min(others.size(), kRoutesPerLandmark));
    for (const auto& [distance, other] : others) pairs.insert(std::minmax(id, other));
  }
  return pairs;
}

void add_routes(ExploredSite& site, const DistanceField& space) {
  std::map<LandmarkId, std::vector<LandmarkId>> goals;
  for (const auto& [a, b] : nearest_pairs(site.graph)) goals[a].push_back(b);
  for (const auto& [from, tos] : goals) {
    std::set<Cell> wanted;
    for (const LandmarkId to : tos) wanted.insert(space.cell_at(site.graph.find(to)->T_map_landmark.position()));
    const auto enough = [&](Cell settled) {
      wanted.erase(settled);
      return wanted.empty();
    };
    const TravelField travel(space, site.graph.find(from)->T_map_landmark.position(), kClearance_m, {}, enough);
    for (const LandmarkId to : tos) {
      std::vector<Point> path;
      for (const Cell cell : travel.path_to(space.cell_at(site.graph.find(to)->T_map_landmark.position())))
        path.push_back(space.centre_of(cell));
      if (path.size() < 2) continue;
      path = shortened(space, path, kClearance_m);
      Route route;
      route.from = from;
      route.to = to;
      route.trajectory = poses_along(path);
      route.cost_m = length_of(route.trajectory);
      site.graph.add_route(route);
      std::swap(route.from, route.to);
      route.id = 0;
      std::ranges::reverse(route.trajectory);
      for (Pose2& pose : route.trajectory) pose.theta_rad = wrap_angle(pose.theta_rad + std::numbers::pi);
      site.graph.add_route(std::move(route));
    }
  }
}

}  // namespace

ExploredSite explored_site(const FloorPlan& plan, double area_m2, std::uint64_t seed) {
  ExploredSite site;
  PortableRandom random(seed, 11);
  const DistanceField space(plan.grid, UnknownPolicy::avoid);
  const std::vector<Cell> cells = standing_cells(plan, space);
  const double free_m2 = static_cast<double>(cells.size()) * plan.grid.cell_m() * plan.grid.cell_m();
  add_landmarks(site, plan, cells, std::max(8, static_cast<int>(free_m2 / area_m2)), random);
  add_routes(site, space);
  return site;
}

}  // namespace cairn
