// What a route may be counted by.
#pragma once

#include <cstdint>
#include <string_view>

#include "maps/clustering/network.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

enum class CostKind : std::uint8_t {
  length,     // metres: cost_m
  time,       // seconds at the robot's speeds, turns included
  clearance,  // metres, counted up to five times where there is little room
};
[[nodiscard]] std::string_view name_of(CostKind kind);
[[nodiscard]] std::string_view unit_of(CostKind kind);  // m or s

// What a metre counts, by clearance, where the robot's edge keeps so much room: 1 where there is enough.
[[nodiscard]] double clearance_weight(double clearance_m);

struct RouteCostRules {
  double speed_mps = 0.4;    // within the route's own limit
  double turn_radps = 1.75;  // on the spot
  double radius_m = 0.22;
  // Read when route_cost() is called; none or empty: by clearance is by length. Unknown ground counts as no room.
  const OccupancyGrid* grid = nullptr;
};

// Along the trajectory; a route without one counts as straight and, by clearance, as roomy.
[[nodiscard]] RouteCost route_cost(CostKind kind, const RouteCostRules& rules);

}  // namespace cairn
