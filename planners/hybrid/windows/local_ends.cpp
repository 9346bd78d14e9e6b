#include "planners/hybrid/windows/local_ends.hpp"

#include <algorithm>
#include <limits>

#include "planners/hybrid/avoided.hpp"

namespace cairn {

bool LocalEnds::has_routes(LandmarkId id) const {
  const LandmarkGraph& graph = ground_.world().graph;
  return !graph.routes_from(id).empty() || !graph.routes_to(id).empty();
}

WorldView LocalEnds::part_round(const Point& p_map, std::shared_ptr<const Window>& window) const {
  window = ground_.window_of(ground_.box_round(p_map, p_map, windows_.reach_blocks));
  WorldView part = with_grid(window->grid, ground_.world());
  part.observation = nullptr;
  return part;
}

std::variant<StartPlace, Refusal> LocalEnds::start(const Place& place) const {
  const LandmarkGraph& graph = ground_.world().graph;
  if (const auto refusal = refusal_of_place(place, graph, "start")) return *refusal;
  std::shared_ptr<const Window> window;
  const SpaceCache none;
  if (place.pose) {
    StartPlace start;
    start.pose = *place.pose;
    start.leave_from = place.pose->position();
    if (ground_.fits_along(start.leave_from, start.leave_from)) return start;
    const WorldView part = part_round(start.leave_from, window);
    return start_of(place, part, rules_, none);
  }
  for (const LandmarkId id : place.landmarks) {
    const auto approach = ground_.approach(*graph.find(id));
    if (!approach) continue;
    StartPlace start;
    start.pose = *approach;
    start.landmark = id;
    start.leave_from = approach->position();
    return start;
  }
  Place first;
  first.landmarks = {place.landmarks.front()};
  const WorldView part = part_round(graph.find(first.landmarks.front())->approach_pose().position(), window);
  return start_of(first, part, rules_, none);
}

std::variant<std::vector<GoalPlace>, Refusal> LocalEnds::goals(const Place& place, const StartPlace& start) const {
  const LandmarkGraph& graph = ground_.world().graph;
  if (const auto refusal = refusal_of_place(place, graph, "goal")) return *refusal;
  std::vector<GoalPlace> goals;
  std::shared_ptr<const Window> window;
  // In a part of the grid nothing is out of reach for certain.
  const auto in_part = [&](const Place& one, const Point& at) {
    StartPlace there = start;
    const WorldView part = part_round(at, window);
    there.patched_grid.reset();
    there.space = {window, &window->routes->space()};
    return goals_of(one, part, rules_, there, [](const Point&) { return true; });
  };
  if (place.pose) {
    const Point at = place.pose->position();
    if (!ground_.fits_along(at, at)) return in_part(place, at);
    const std::optional<double> heading = place.heading_matters ? std::optional(place.pose->theta_rad) : std::nullopt;
    goals.push_back({*place.pose, heading, 0, ""});
    return goals;
  }
  std::optional<Refusal> refusal;
  for (const LandmarkId id : place.landmarks) {
    const Landmark& landmark = *graph.find(id);
    const Point at = landmark.approach_pose().position();
    if (landmark.access && ground_.fits_along(at, at)) {
      goals.push_back({*landmark.access, std::nullopt, id, ""});
      continue;
    }
    Place one;
    one.landmarks = {id};
    auto found = in_part(one, at);
    if (auto* some = std::get_if<std::vector<GoalPlace>>(&found))
      goals.insert(goals.end(), some->begin(), some->end());
    else if (!refusal)
      refusal = std::get<Refusal>(found);
  }
  if (goals.empty()) return *refusal;
  return goals;
}

std::optional<NearGoal> LocalEnds::nearest(const StartPlace& start, const std::vector<GoalPlace>& goals,
                                           double within_m) const {
  const Point from = start.leave_from;
  std::optional<NearGoal> nearest;
  for (std::size_t i = 0; i < goals.size() && !budget_.exhausted(); ++i) {
    const Point to = goals[i].pose.position();
    const double straight_m = (to - from).norm();
    if (straight_m > within_m || (nearest && straight_m >= nearest->min_m)) continue;
    const CellBox box = ground_.box_round(from, to, windows_.reach_blocks);
    const double inside_m = ground_.window_of(box)->routes->length_lower_bound_m(from, to, budget_);
    const double min_m = std::min(inside_m, ground_.min_outside_m(from, to, box));
    if (!nearest || min_m < nearest->min_m) nearest = {i, min_m};
  }
  return nearest;
}

// To every landmark that has routes and is reached in the first window in which any is.
void LocalEnds::join(const Point& at, LandmarkId landmark, std::size_t goal, SymbolicEnd& end) const {
  if (landmark != 0 && has_routes(landmark)) return end.add(landmark, 0.0, goal);
  const WorldView& world = ground_.world();
  CellBox before;
  for (int reach = windows_.reach_blocks; reach <= windows_.max_reach_blocks; reach *= 2) {
    const CellBox box = ground_.box_round(at, at, reach);
    if (box == before || budget_.exhausted()) return;
    before = box;
    const std::shared_ptr<const Window> window = ground_.window_of(box);
    bool is_joined = false;
    for (const auto& [id, other] : world.graph.landmarks()) {
      if (!box.contains(world.grid.cell_at(other.approach_pose().position())) || !has_routes(id)) continue;
      const auto approach = approach_pose(window->routes->space(), other, disc_m(),
                                          [&](const Point& p) { return window->routes->may_reach(at, p); });
      if (!approach) continue;
      const double travel_m = window->routes->length_lower_bound_m(at, approach->position(), budget_);
      if (travel_m == std::numeric_limits<double>::infinity()) continue;
      end.add(id, travel_m, goal);
      is_joined = true;
    }
    if (is_joined) return;
  }
}

SymbolicEnd LocalEnds::joined(const StartPlace& start) const {
  SymbolicEnd end;
  join(start.leave_from, start.landmark, 0, end);
  return end;
}

SymbolicEnd LocalEnds::joined(const std::vector<GoalPlace>& goals) const {
  SymbolicEnd end;
  for (std::size_t i = 0; i < goals.size(); ++i) join(goals[i].pose.position(), goals[i].landmark, i, end);
  return end;
}

}  // namespace cairn
