// Whether the map has been exchanged for another that has places elsewhere: landmarks and the robot have their places
// in the new one, and what a behaviour keeps in coordinates of the old one is to be moved or dropped.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "framework/contracts/world_view.hpp"

namespace cairn::behaviours {

struct MapExchange {
  const MapMove* move = nullptr;  // how places have moved; null: not known, they are worth nothing
};

class MapWatch {
 public:
  // Every tick; none: it is the same map as in the tick before.
  [[nodiscard]] std::optional<MapExchange> update(const WorldView& world) {
    const std::uint64_t before = moves_.value_or(world.map_moves);
    moves_ = world.map_moves;
    if (before == world.map_moves) return std::nullopt;
    return MapExchange{before + 1 == world.map_moves ? world.last_map_move : nullptr};
  }

 private:
  std::optional<std::uint64_t> moves_;
};

inline void move_place(const MapMove& move, Point& at_m) {
  at_m = move.near(at_m) * at_m;
}
inline void move_place(const MapMove& move, Pose2& pose) {
  pose = move.near(pose.position()) * pose;
}
template <class Place>
void move_places(const MapMove& move, std::vector<Place>& places) {
  for (Place& place : places) move_place(move, place);
}

}  // namespace cairn::behaviours
