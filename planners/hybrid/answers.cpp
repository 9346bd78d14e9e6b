#include "planners/hybrid/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "framework/contracts/adapters/lone_planners.hpp"
#include "maps/base/text.hpp"
#include "planners/hybrid/segments.hpp"

namespace cairn {
namespace {

std::vector<Point> points_on(const std::vector<Pose2>& path) {
  std::vector<Point> points;
  points.reserve(path.size());
  for (const Pose2& pose : path) points.push_back(pose.position());
  return points;
}

std::vector<PartedPoint> shortened(const ShortcutRules& rules, const std::vector<PartedPoint>& route,
                                   const Budget& budget) {
  return tightened(rules, straightened(rules, route, 1, budget), 1, budget);
}

// Each segment keeps its part.
std::vector<PartedPoint> reversed(const std::vector<PartedPoint>& route) {
  std::vector<PartedPoint> back(route.rbegin(), route.rend());
  for (std::size_t i = 1; i < back.size(); ++i) back[i].part = route[route.size() - i].part;
  back.front().part = route.front().part;
  return back;
}

}  // namespace

double escape_m(const StartPlace& start) {
  return start.escape ? (start.escape->to - start.pose.position()).norm() : 0.0;
}

PathRequest direct_request(const PlanRequest& request, const StartPlace& start, const GoalPlace& goal) {
  PathRequest direct = path_request_of(request);
  direct.from = {Pose2{start.leave_from.x(), start.leave_from.y(), start.pose.theta_rad}, false, {}};
  direct.to = {goal.pose, goal.heading_rad.has_value(), {}};
  return direct;
}

std::vector<PartedPoint> shortened_from_both_ends(const ShortcutRules& rules, const std::vector<PartedPoint>& route,
                                                  const Budget& budget) {
  std::vector<PartedPoint> onwards = shortened(rules, route, budget);
  std::vector<PartedPoint> back = reversed(shortened(rules, reversed(route), budget));
  return length_of(points_of(back)) < length_of(points_of(onwards)) ? back : onwards;
}

PlanResult joined(const AnswerRules& rules, const PlanningGround& ground, const Budget& budget, const StartPlace& start,
                  const GoalPlace& goal, std::vector<PartedPoint> route, std::vector<PathSegment> parts) {
  if (rules.shortcut) {
    const ShortcutRules shortcuts = ground.shortcuts(rules.shortcut_clearance_m);
    route =
        rules.from_both_ends ? shortened_from_both_ends(shortcuts, route, budget) : shortened(shortcuts, route, budget);
  }
  if (start.escape) {
    parts.push_back({PathSegment::Origin::escape, 0, 0.0});
    route.front().part = static_cast<int>(parts.size()) - 1;
    route.insert(route.begin(), {start.pose.position(), 0});
  }
  const auto same_place = [](const PartedPoint& a, const PartedPoint& b) { return a.at == b.at; };
  route.erase(std::unique(route.begin(), route.end(), same_place), route.end());
  const std::vector<Point> points = points_of(route);
  if (!route_is_free(ground.world().grid, rules.ground, points, rules.radius_m, start.escape))
    throw std::logic_error(fmt::format("hybrid: the re-check refused a path of {} points from {} to {}, radius {:f}",
                                       points.size(), text_of(points.front()), text_of(points.back()), rules.radius_m));
  PlanResult result;
  result.outcome = PlanOutcome::solved;
  result.length_m = length_of(points);
  result.cost_m = result.length_m;
  result.clearance_m = ground.clearance_m(points, rules.robot_m);
  if (rules.driving) result.driving_time_s = ground.driving_time_s(points, *rules.driving);
  result.path = poses_along(points, start.pose.theta_rad, goal.heading_rad);
  result.segments = segments_of(route, parts);
  return result;
}

PlanResult over_landmarks(const AnswerRules& rules, const PlanningGround& ground, const Budget& budget,
                          const StartPlace& start, const GoalPlace& goal, const SymbolicPath& path, const Walk& walk) {
  PlanResult result = joined(rules, ground, budget, start, goal, walk.route, walk.parts);
  result.cost_m = walk.cost_m;
  result.landmarks = path.landmarks;
  result.routes = path.routes;
  result.reason =
      fmt::format("over {}, by {} stored and {} newly planned legs{}{}", counted(path.landmarks.size(), "landmark"),
                  walk.stored_legs, walk.planned_legs, goal.note, escape_text(start));
  return result;
}

PlanResult as_planned(const AnswerRules& rules, const PlanningGround& ground, const StartPlace& start,
                      const GoalPlace& goal, const PlanResult& planned) {
  if (!route_is_free(ground.world().grid, rules.ground, points_on(planned.path), rules.radius_m)) {
    return refused<PlanResult>(
        {PlanOutcome::out_of_budget, "the route planner's path touches something and was refused"});
  }
  PlanResult result = planned;
  const auto origin = planned.path.size() == 2 ? PathSegment::Origin::straight : PathSegment::Origin::planned;
  result.segments.clear();
  if (planned.path.size() > 1) result.segments.push_back({origin, 0, planned.length_m});
  if (start.escape) {
    result.path.insert(result.path.begin(),
                       poses_along({start.pose.position(), start.escape->to}, start.pose.theta_rad, {}).front());
    result.segments.insert(result.segments.begin(), {PathSegment::Origin::escape, 0, escape_m(start)});
    result.length_m += escape_m(start);
    result.cost_m += escape_m(start);
    result.length_lower_bound_m.reset();
  }
  const std::vector<Point> points = points_on(result.path);
  result.clearance_m = ground.clearance_m(points, rules.robot_m);
  if (rules.driving) result.driving_time_s = ground.driving_time_s(points, *rules.driving);
  result.landmarks.clear();
  const bool is_there = planned.outcome == PlanOutcome::solved;
  for (const LandmarkId id : {start.landmark, is_there ? goal.landmark : 0})
    if (id != 0 && (result.landmarks.empty() || result.landmarks.back() != id)) result.landmarks.push_back(id);
  result.reason = planned.reason + (is_there ? goal.note : "") + escape_text(start);
  return result;
}

std::string text_of_route(RouteId id, const LandmarkGraph& graph) {
  const Route& route = *graph.find_route(id);
  return fmt::format("route R{} ({} to {})", id, label_of(*graph.find(route.from)), label_of(*graph.find(route.to)));
}

void report_blocked(const std::set<RouteId>& blocked, const LandmarkGraph& graph, PlanResult& result) {
  for (const RouteId id : blocked) {
    result.blocked_routes.push_back(id);
    result.reason += "; " + text_of_route(id, graph) + " is blocked";
  }
}

}  // namespace cairn
