#include "plugins/behaviours/driving/route_goal.hpp"

#include <algorithm>

#include "plugins/behaviours/places/map_watch.hpp"

namespace cairn::behaviours {

void RouteGoal::record(const PlanResult& result, const std::vector<Point>& path) {
  if (!path.empty()) route_end_ = path.back();
  const auto reached = std::find_if(result.landmarks.rbegin(), result.landmarks.rend(), [&](LandmarkId id) {
    return std::ranges::find(place_.landmarks, id) != place_.landmarks.end();
  });
  landmark_ = reached == result.landmarks.rend() ? 0 : *reached;
}

void RouteGoal::move(const MapMove& move) {
  if (route_end_) move_place(move, *route_end_);
}

std::optional<Point> RouteGoal::point(const LandmarkGraph& graph) const {
  if (place_.pose) return place_.pose->position();
  if (route_end_) return route_end_;
  for (const LandmarkId id : place_.landmarks)
    if (const Landmark* landmark = graph.find(id))
      return landmark->access.value_or(landmark->T_map_landmark).position();
  return std::nullopt;
}

}  // namespace cairn::behaviours
