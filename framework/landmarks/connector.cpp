#include "framework/landmarks/connector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "maps/geometry/segments.hpp"
#include "maps/grid/differing_cells.hpp"
#include "maps/grid/distance_field.hpp"
#include "maps/grid/travel_field.hpp"

namespace cairn {
namespace {

constexpr double kAccessReach_m = 1.5;  // an approach pose lies no further from the landmark's centre

// The reachable cell nearest to the landmark, looking at it.
std::optional<Pose2> approach_pose(const DistanceField& space, const TravelField& reach, const Point& landmark) {
  const int radius = static_cast<int>(std::ceil(kAccessReach_m / space.cell_m()));
  const Cell centre = space.cell_at(landmark);
  std::optional<Cell> best;
  double best_distance = kAccessReach_m;
  for (int y = centre.y - radius; y <= centre.y + radius; ++y)
    for (int x = centre.x - radius; x <= centre.x + radius; ++x) {
      if (!reach.reaches({x, y})) continue;
      const double distance = (space.centre_of({x, y}) - landmark).norm();
      if (distance < best_distance) {
        best_distance = distance;
        best = Cell{x, y};
      }
    }
  if (!best) return std::nullopt;
  const Point at = space.centre_of(*best);
  return Pose2{at.x(), at.y(), std::atan2(landmark.y() - at.y(), landmark.x() - at.x())};
}

// Open or not, in both directions.
std::vector<RouteId> routes_joining(const LandmarkGraph& graph, LandmarkId from, LandmarkId to) {
  std::vector<RouteId> ids;
  for (const RouteId id : graph.routes_from(from))
    if (graph.find_route(id)->to == to) ids.push_back(id);
  return ids;
}

// Gives the only route from one landmark to another this content, under its old id where there is one.
void put_route(LandmarkGraph& graph, Route route) {
  const std::vector<RouteId> known = routes_joining(graph, route.from, route.to);
  if (!known.empty()) {
    const Route& old = *graph.find_route(known.front());
    route.id = old.id;
    if (known.size() == 1 && old == route) return;
  }
  for (const RouteId id : known) graph.remove_route(id);
  graph.add_route(std::move(route));
}

void remove_routes_but(LandmarkGraph& graph, const std::set<std::pair<LandmarkId, LandmarkId>>& kept) {
  std::vector<RouteId> unwanted;
  for (const auto& [id, route] : graph.routes())
    if (!kept.contains(std::minmax(route.from, route.to))) unwanted.push_back(id);
  for (const RouteId id : unwanted) graph.remove_route(id);
}

}  // namespace

void LandmarkConnector::connect(LandmarkGraph& graph, const DrivenPath& driven, const WorldView& world,
                                const Plan& plan, std::uint64_t seed) {
  find_access(graph, world);
  const std::vector<Point> changed_m =
      planned_on_ ? centres_of_changed_states(*planned_on_, world.grid) : std::vector<Point>{};
  const std::vector<Pair> pairs = wanted_pairs(graph);
  remove_routes_but(graph, {pairs.begin(), pairs.end()});
  std::map<Pair, Link> links;
  for (const Pair& pair : pairs) {
    const Landmark& from = *graph.find(pair.first);
    const Landmark& to = *graph.find(pair.second);
    const auto known = links_.find(pair);
    const bool is_kept = known != links_.end() && is_current(known->second, from, to, changed_m);
    Link link = is_kept ? known->second : planned(from, to, plan, seed);
    store(graph, pair, link, driven);
    links.emplace(pair, std::move(link));
  }
  links_ = std::move(links);
  planned_on_ = world.grid;
}

void LandmarkConnector::find_access(LandmarkGraph& graph, const WorldView& world) const {
  const DistanceField space(world.grid, UnknownPolicy::avoid);
  // Distances run between cell centres: half a diagonal on either side makes the disc fit.
  const double clearance = robot_.radius_m + config_.access_margin_m + std::numbers::sqrt2 * world.grid.cell_m() / 2;
  const TravelField reach(space, world.pose.T_map_robot.position(), clearance);
  for (const auto& [id, landmark] : graph.landmarks())
    graph.find(id)->access = approach_pose(space, reach, landmark.T_map_landmark.position());
}

// Each landmark with its nearest others that have an approach pose too.
std::vector<LandmarkConnector::Pair> LandmarkConnector::wanted_pairs(const LandmarkGraph& graph) const {
  std::set<Pair> pairs;
  for (const auto& [id, landmark] : graph.landmarks()) {
    std::vector<std::pair<double, LandmarkId>> others;
    for (const auto& [other_id, other] : graph.landmarks())
      if (other_id != id)
        others.emplace_back((other.T_map_landmark.position() - landmark.T_map_landmark.position()).norm(), other_id);
    const auto count = std::min(others.size(), static_cast<std::size_t>(config_.routes_per_landmark));
    const auto end = others.begin() + static_cast<std::ptrdiff_t>(count);
    std::partial_sort(others.begin(), end, others.end());
    for (auto other = others.begin(); other != end; ++other)
      if (landmark.access && graph.find(other->second)->access) pairs.insert(std::minmax(id, other->second));
  }
  return {pairs.begin(), pairs.end()};
}

// A path of at most that length stays where its distances from both ends add up to no more; the robot's disc reaches a
// radius beyond.
bool LandmarkConnector::is_current(const Link& link, const Landmark& from, const Landmark& to,
                                   const std::vector<Point>& changed_m) const {
  if (link.from != *from.access || link.to != *to.access) return false;
  if (!link.path) return changed_m.empty();
  const double within_m = link.length_m + 2.0 * (robot_.radius_m + planned_on_->cell_m());
  return std::ranges::none_of(changed_m, [&](const Point& at) {
    return (at - link.from.position()).norm() + (at - link.to.position()).norm() <= within_m;
  });
}

LandmarkConnector::Link LandmarkConnector::planned(const Landmark& from, const Landmark& to, const Plan& plan,
                                                   std::uint64_t seed) const {
  PlanRequest request;
  request.from.pose = from.access;
  request.to.pose = to.access;
  request.radius_m = robot_.radius_m + kMaxRounding_m;
  request.seed = seed;
  PlanResult result = plan(request);
  Link link{*from.access, *to.access, std::nullopt, 0.0};
  if (result.outcome != PlanOutcome::solved) return link;
  link.path = std::move(result.path);
  link.length_m = result.length_m;
  return link;
}

void LandmarkConnector::store(LandmarkGraph& graph, const Pair& pair, const Link& link,
                              const DrivenPath& driven) const {
  if (!link.path) {
    for (const auto& [from, to] : {pair, Pair(pair.second, pair.first)})
      for (const RouteId id : routes_joining(graph, from, to)) graph.remove_route(id);
    return;
  }
  const std::vector<Pose2> stretch = driven.between(link.from, link.to);
  Route route;
  route.from = pair.first;
  route.to = pair.second;
  route.driven = !stretch.empty() && length_of(stretch) <= config_.driven_detour_ratio * link.length_m;
  route.trajectory = in_whole_steps(route.driven ? stretch : *link.path);
  route.cost_m = length_of(route.trajectory);
  Route back = route;
  std::swap(back.from, back.to);
  back.trajectory = in_whole_steps(reversed(back.trajectory));
  put_route(graph, std::move(route));
  put_route(graph, std::move(back));
}

}  // namespace cairn
