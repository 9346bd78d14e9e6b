// Answers made of what was walked or planned: joined, shortened and re-checked.
#pragma once

#include <set>
#include <vector>

#include "planners/common/disc_space/driving_time.hpp"
#include "planners/common/disc_space/ends.hpp"
#include "planners/hybrid/legs.hpp"

namespace cairn {

struct AnswerRules {
  GroundRules ground;
  double robot_m = 0.22;   // radius of the robot, from which clearances are counted
  double radius_m = 0.22;  // of the disc that must fit, with the margin
  bool shortcut = true;
  std::optional<DrivingRules> driving{};  // the robot, where it is known
  double shortcut_clearance_m = 0.0;      // that cut corners keep on top of radius_m
  bool from_both_ends = false;            // corners are cut from either end, which takes twice the time
};

[[nodiscard]] double escape_m(const StartPlace& start);  // length of its escape; 0: none

// From where the start is left to the goal, for the path planner.
[[nodiscard]] PathRequest direct_request(const PlanRequest& request, const StartPlace& start, const GoalPlace& goal);

// Its corners cut from the first point on, and from the last one: the shorter of the two, the former when equal.
[[nodiscard]] std::vector<PartedPoint> shortened_from_both_ends(const ShortcutRules& rules,
                                                                const std::vector<PartedPoint>& route,
                                                                const Budget& budget);

// Joins, shortens and re-checks on the ground's grid; `route` begins where the start is left. std::logic_error when the
// re-check refuses it. Corners that the budget leaves no time for stay.
[[nodiscard]] PlanResult joined(const AnswerRules& rules, const PlanningGround& ground, const Budget& budget,
                                const StartPlace& start, const GoalPlace& goal, std::vector<PartedPoint> route,
                                std::vector<PathSegment> parts);

// Of a walk that is complete, along its symbolic path.
[[nodiscard]] PlanResult over_landmarks(const AnswerRules& rules, const PlanningGround& ground, const Budget& budget,
                                        const StartPlace& start, const GoalPlace& goal, const SymbolicPath& path,
                                        const Walk& walk);

// The path planner's path as it is, from where the start is left: there is nothing to join it to. Without a path when
// it touches something.
[[nodiscard]] PlanResult as_planned(const AnswerRules& rules, const PlanningGround& ground, const StartPlace& start,
                                    const GoalPlace& goal, const PlanResult& planned);

// Names the routes, which are not passable today, in the result and in its reason.
void report_blocked(const std::set<RouteId>& blocked, const LandmarkGraph& graph, PlanResult& result);
[[nodiscard]] std::string text_of_route(RouteId id, const LandmarkGraph& graph);

}  // namespace cairn
