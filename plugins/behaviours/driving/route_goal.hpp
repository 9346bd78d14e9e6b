// Where a drive goes, and which place of the map that is by the last plan.
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/planner.hpp"
#include "framework/contracts/world_view.hpp"

namespace cairn::behaviours {

class RouteGoal {
 public:
  void set(const Place& place) { place_ = place; }
  // What a solved plan leads to.
  void record(const PlanResult& result, const std::vector<Point>& path);

  // The map has been exchanged.
  void move(const MapMove& move);

  [[nodiscard]] const Place& place() const { return place_; }
  // The landmark that the route ends at; 0: a place, or no route yet.
  [[nodiscard]] LandmarkId landmark() const { return landmark_; }
  // The place itself, the end of the last route, or of some landmark; none where nothing is known.
  [[nodiscard]] std::optional<Point> point(const LandmarkGraph& graph) const;
  // Whether it is more than the guess where some landmark is.
  [[nodiscard]] bool is_exact() const { return place_.pose || route_end_; }

 private:
  Place place_;
  LandmarkId landmark_ = 0;
  std::optional<Point> route_end_;  // of the last plan that was solved
};

}  // namespace cairn::behaviours
