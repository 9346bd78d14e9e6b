#include "framework/mission/loop/world_state.hpp"

namespace cairn {

WorldView WorldState::view() const {
  WorldView world{*grid,
                  known_graph(),
                  robot,
                  pose,
                  time_s,
                  has_observation ? &observation : nullptr,
                  driven.speed_reduction_ratio};
  world.T_map_start = T_map_start;
  world.hierarchies = is_lost() ? nullptr : hierarchies;
  world.speed_law = speed_law;
  world.map_moves = map_moves;
  world.last_map_move = last_map_move;
  return world;
}

double WorldState::explored_ratio() const {
  return grid == nullptr ? 0.0 : known_ratio(*grid);
}

}  // namespace cairn
