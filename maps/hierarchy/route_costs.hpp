// What a route may be counted by.
#pragma once

#include <memory>
#include <string_view>

#include "maps/distance_field.hpp"
#include "maps/hierarchy/network.hpp"

namespace cairn {

enum class CostKind : std::uint8_t {
  length,     // metres: cost_m
  time,       // seconds at the robot's speeds, turns included
  clearance,  // metres, counted up to five times where there is little room
};
[[nodiscard]] std::string_view name_of(CostKind kind);
[[nodiscard]] std::string_view unit_of(CostKind kind);  // m or s

struct RouteCostRules {
  double speed_mps = 0.4;    // within the route's own limit
  double turn_radps = 1.75;  // on the spot
  double radius_m = 0.22;
  // Of the map; none: by clearance is by length. Unknown ground counts as no room.
  std::shared_ptr<const DistanceField> field;
};

// Along the trajectory; a route without one counts as straight and, by clearance, as roomy.
[[nodiscard]] RouteCost route_cost(CostKind kind, const RouteCostRules& rules);

}  // namespace cairn
