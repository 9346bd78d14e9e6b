// When the plan that a mission has published last is over: no event says so.
#pragma once

#include "framework/mission/events.hpp"

namespace cairn {

// With a behaviour's end, or when the robot stands on the goal.
[[nodiscard]] inline bool is_end_of_plan(const Event& event, const WorldView& world, const Point& goal_m) {
  if (std::holds_alternative<StepEnded>(event)) return true;
  if (std::holds_alternative<TickDone>(event))
    return (world.pose.T_map_robot.position() - goal_m).norm() < world.robot.radius_m;
  const auto* const ended = std::get_if<NodeEnded>(&event);
  return ended != nullptr && ended->kind == NodeKind::behaviour;
}

}  // namespace cairn
