#include "framework/landmarks/connector.hpp"

#include <algorithm>
#include <numbers>
#include <set>

#include "framework/landmarks/approach_poses.hpp"
#include "framework/landmarks/trajectories.hpp"
#include "maps/geometry/segments.hpp"
#include "maps/grid/differing_cells.hpp"
#include "maps/grid/distance_field.hpp"
#include "maps/landmarks/joined_landmarks.hpp"

namespace cairn {
namespace {

constexpr int kMaxTries = 3;  // pairs planned to join the same two sets of landmarks, beyond those wanted anyway

// Open or not, in one direction.
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

bool is_on_the_grid(const Route& route, const LandmarkGraph& graph) {
  return graph.find(route.from)->level == 0 && graph.find(route.to)->level == 0;
}

bool is_at(const Pose2& pose, const Pose2& place) {
  return (pose.position() - place.position()).norm() <= std::numbers::sqrt2 * kMaxRounding_m;
}

}  // namespace

struct LandmarkConnector::Round {
  LandmarkGraph& graph;
  const DrivenPath& driven;
  const OccupancyGrid& grid;
  const Plan& plan;
  std::uint64_t seed;
  std::vector<Point> changed_m;  // cells that have changed since the last connect()
  std::map<RouteEnds, Link> links = {};
  JoinedLandmarks joined = {};
};

void LandmarkConnector::connect(LandmarkGraph& graph, const DrivenPath& driven, const WorldView& world,
                                const Plan& plan, std::uint64_t seed) {
  const DistanceField space(world.grid, UnknownPolicy::avoid);
  const DiscLattice lattice(space, planned_radius_m());
  // Distances run between cell centres: half a diagonal on either side makes the disc fit.
  const double clearance_m = radius_with_margin_m() + std::numbers::sqrt2 * space.cell_m() / 2;
  find_approach_poses(graph, {space, lattice, clearance_m}, driven, world.pose.T_map_robot);
  const JoinCandidates candidates(graph, world.grid, lattice);

  Round round{graph, driven, world.grid, plan, seed, {}};
  if (planned_on_) round.changed_m = centres_of_changed_states(*planned_on_, world.grid);
  for (const RouteEnds& pair : candidates.wanted(config_.routes_per_landmark)) join(round, pair);
  join_what_is_apart(round, candidates);
  remove_unwanted(round);
  links_ = std::move(round.links);
  planned_on_ = world.grid;
}

bool LandmarkConnector::join(Round& round, const RouteEnds& pair) const {
  const Landmark& from = *round.graph.find(pair.first);
  const Landmark& to = *round.graph.find(pair.second);
  const auto known = links_.find(pair);
  const bool is_kept = known != links_.end() && is_current(known->second, from, to, round);
  Link link = is_kept ? known->second : planned(round, from, to);
  link.has_moved = false;
  return store(round, pair, link);
}

// Sets that the wanted pairs have left apart, because the planner found no path for them: the next pairs between them,
// then whatever path the grid has. A robot that cannot turn on the spot might not follow that one.
void LandmarkConnector::join_what_is_apart(Round& round, const JoinCandidates& candidates) const {
  JoinedLandmarks& joined = round.joined;
  std::map<RouteEnds, int> tries;
  for (const auto& [pair, length_m] : candidates.by_length()) {
    if (joined.are_joined(pair.first, pair.second) || round.links.contains(pair)) continue;
    if (++tries[std::minmax({joined.set_of(pair.first), joined.set_of(pair.second)})] <= kMaxTries) join(round, pair);
  }
  if (robot_.kinematics != Kinematics::differential) return;
  for (std::size_t i = 0; i < candidates.by_length().size(); ++i) {
    const RouteEnds& pair = candidates.by_length()[i].pair;
    if (!joined.are_joined(pair.first, pair.second)) store(round, pair, over_cells(round, pair, candidates.path_of(i)));
  }
}

void LandmarkConnector::remove_unwanted(Round& round) const {
  std::set<RouteEnds> kept;
  std::vector<RouteId> unwanted;
  for (const auto& [id, route] : round.graph.routes()) {
    const RouteEnds pair = std::minmax(route.from, route.to);
    if (round.links.contains(pair) || !is_on_the_grid(route, round.graph)) continue;
    if (is_good(route, round) && round.joined.join(route.from, route.to)) kept.insert(pair);
    if (!kept.contains(pair)) unwanted.push_back(id);
  }
  for (const RouteId id : unwanted) round.graph.remove_route(id);
}

// A path of at most that length stays where its distances from both ends add up to no more; the robot's disc reaches a
// radius beyond. One with more room beside it is taken though it is a little longer.
bool LandmarkConnector::is_current(const Link& link, const Landmark& from, const Landmark& to,
                                   const Round& round) const {
  if (link.from != *from.access || link.to != *to.access) return false;
  if (link.has_moved) return is_free(*link.path, round.grid, planned_radius_m());
  const std::vector<Point>& changed_m = round.changed_m;
  if (!link.is_planned) return changed_m.empty();
  const double within_m = kMaxMarginDetour * link.length_m + 2.0 * (radius_with_margin_m() + planned_on_->cell_m());
  return std::ranges::none_of(changed_m, [&](const Point& at) {
    return (at - link.from.position()).norm() + (at - link.to.position()).norm() <= within_m;
  });
}

void LandmarkConnector::move(const MapMove& move, const LandmarkGraph& graph,
                             const std::function<bool(LandmarkId)>& has_moved) {
  std::map<RouteEnds, Link> links;
  for (const auto& [pair, link] : links_) {
    const Landmark* const from = graph.find(pair.first);
    const Landmark* const to = graph.find(pair.second);
    const bool is_known = link.path && from != nullptr && from->access && to != nullptr && to->access;
    if (!is_known || has_moved(pair.first) != has_moved(pair.second)) continue;
    const std::optional<Link> now = has_moved(pair.first) ? moved(move, link, *from->access, *to->access) : link;
    if (now) links.emplace(pair, *now).first->second.has_moved = true;
  }
  links_ = std::move(links);
  planned_on_.reset();
}

// Between the approach poses as they are now; none: it was bent.
std::optional<LandmarkConnector::Link> LandmarkConnector::moved(const MapMove& move, const Link& link,
                                                                const Pose2& from, const Pose2& to) {
  std::vector<Point> points;
  points.reserve(link.path->size());
  for (const Pose2& pose : *link.path) points.push_back(pose.position());
  Link now = link;
  now.from = from;
  now.to = to;
  for (Pose2& pose : *now.path) pose = move.near(pose.position()) * pose;
  const double off_m = std::max((now.path->front().position() - from.position()).norm(),
                                (now.path->back().position() - to.position()).norm());
  if (std::max(off_m, moved_path(move, points).bend_m) > kMaxBend_m) return std::nullopt;
  now.path->front() = from;
  now.path->back() = to;
  now.length_m = length_of(*now.path);
  return now;
}

// Open, free, and between the approach poses of its landmarks.
bool LandmarkConnector::is_good(const Route& route, const Round& round) const {
  const Landmark& from = *round.graph.find(route.from);
  const Landmark& to = *round.graph.find(route.to);
  return !route.closed && !route.trajectory.empty() && from.access && to.access &&
         is_at(route.trajectory.front(), *from.access) && is_at(route.trajectory.back(), *to.access) &&
         is_free(route.trajectory, round.grid, robot_.radius_m);
}

LandmarkConnector::Link LandmarkConnector::planned(const Round& round, const Landmark& from, const Landmark& to) const {
  PlanRequest request;
  request.from.pose = from.access;
  request.to.pose = to.access;
  request.radius_m = planned_radius_m();
  request.seed = round.seed;
  PlanResult result = round.plan(request);
  Link link{*from.access, *to.access, std::nullopt};
  if (result.outcome == PlanOutcome::solved) {
    link.path = std::move(result.path);
    link.length_m = result.length_m;
    link.is_planned = true;
    return link;
  }
  for (const RouteId id : routes_joining(round.graph, from.id, to.id)) {
    const Route& known = *round.graph.find_route(id);
    if (!is_good(known, round)) continue;
    link.path = known.trajectory;
    link.length_m = length_of(known.trajectory);
  }
  return link;
}

LandmarkConnector::Link LandmarkConnector::over_cells(const Round& round, const RouteEnds& pair,
                                                      const std::vector<Cell>& cells) const {
  const Pose2 from = *round.graph.find(pair.first)->access;
  const Pose2 to = *round.graph.find(pair.second)->access;
  Link link{from, to, trajectory_over(from, cells, to, round.grid, planned_radius_m())};
  link.length_m = length_of(*link.path);
  return link;
}

bool LandmarkConnector::store(Round& round, const RouteEnds& pair, const Link& link) const {
  round.links.insert_or_assign(pair, link);
  LandmarkGraph& graph = round.graph;
  const std::vector<Pose2> stretch = round.driven.between(link.from, link.to);
  Route route;
  route.from = pair.first;
  route.to = pair.second;
  route.driven = (!link.path || length_of(stretch) <= config_.driven_detour_ratio * link.length_m) &&
                 is_free(stretch, round.grid, planned_radius_m()) &&
                 (!link.path || is_free(stretch, round.grid, radius_with_margin_m()) ||
                  !is_free(*link.path, round.grid, radius_with_margin_m()));
  if (!route.driven && !link.path) {
    for (const auto& [from, to] : {pair, RouteEnds(pair.second, pair.first)})
      for (const RouteId id : routes_joining(graph, from, to)) graph.remove_route(id);
    return false;
  }
  route.trajectory = in_whole_steps(route.driven ? stretch : *link.path);
  route.cost_m = length_of(route.trajectory);
  Route back = route;
  std::swap(back.from, back.to);
  back.trajectory = in_whole_steps(reversed(back.trajectory));
  put_route(graph, std::move(route));
  put_route(graph, std::move(back));
  round.joined.join(pair.first, pair.second);
  return true;
}

}  // namespace cairn
