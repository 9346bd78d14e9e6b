#include "plugins/behaviours/driving/planner_requests.hpp"

namespace cairn::behaviours {

void PlanningSettings::describe(Fields<PlanningSettings>& fields) {
  using C = PlanningSettings;
  fields.numbers("clearances_m", &C::clearances_m, {0.0, 5.0}, "m",
                 "room that the planner is asked to leave beside the robot, one after the other until it finds a path; "
                 "[0.12, 0.06, 0] unless given");
  fields.number("plans_apart_s", &C::plans_apart_s, {0.0, 600.0}, "s", "between two plans of one drive");
  fields.number("local_plans_apart_s", &C::local_plans_apart_s, {0.0, 600.0}, "s",
                "the same for plans on the local map, which take longer");
  fields.integer("max_plans", &C::max_plans, {1.0, 1e6}, "after so many plans the drive is given up");
  fields.number("closed_for_s", &C::closed_for_s, {0.0, 1e6}, "s",
                "a stored route that was found blocked is left out of plans for so long");
}

void PlannerRequests::tick(double time_s) {
  std::erase_if(closed_until_s_, [&](const auto& closed) { return closed.second < time_s; });
}

PlanResult PlannerRequests::ask(const Place& goal, const WorldView& world, MotionRequests& context) {
  PlanRequest request;
  request.from.pose = world.pose.T_map_robot;
  request.to = goal;
  request.seed = seed_ + static_cast<std::uint64_t>(plans_);
  request.speed_mps = speed_mps_;
  ++plans_;
  planned_s_ = world.time_s;
  for (const auto& [route, until_s] : closed_until_s_) request.closed.push_back(route);
  PlanResult result;
  for (const bool with_closed : {true, false}) {
    if (!with_closed && request.closed.empty()) break;
    if (!with_closed) request.closed.clear();
    for (const double clearance_m : settings_.clearances_m) {
      request.radius_m = world.robot.radius_m + clearance_m;
      result = context.plan(request);
      for (const RouteId route : result.blocked_routes) close(route, world.time_s);
      if (result.outcome == PlanOutcome::solved || is_refusal(result.outcome)) return result;
    }
  }
  return result;
}

}  // namespace cairn::behaviours
