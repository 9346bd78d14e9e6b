// What a route on the grid is counted by: length, time, room, or all of them weighted.
#pragma once

#include <cstdint>

#include "planners/common/disc_space/disc_space.hpp"

namespace cairn {

// Added to the seed of an informed sampler: apart from the numbers of the plain samplers.
inline constexpr std::uint64_t kInformedStream = 0x1000;

enum class Objective : std::uint8_t {
  as_asked,   // the request's cost; not for a TravelCost
  length,     // metres
  time,       // seconds at the robot's greatest speed
  clearance,  // metres, counted up to five times where there is little room, as on the landmark graph
  weighted,   // metres + seconds + what clearance adds to the metres, each with its weight
};

struct TravelCostRules {
  Objective objective = Objective::length;
  double length_weight = 1.0;  // of `weighted`
  double time_weight = 1.0;
  double clearance_weight = 1.0;
  double unknown_weight = 1.0;  // what a metre over unknown ground counts, at least 1
  double speed_mps = 0.4;
  double radius_m = 0.0;
};

// Borrows the grid and the space. Thread-safe.
class TravelCost {
 public:
  TravelCost(const OccupancyGrid& grid, const DiscSpace& space, const TravelCostRules& rules);

  // Nothing but the length counts.
  [[nodiscard]] bool is_length() const { return rules_.objective == Objective::length && rules_.unknown_weight <= 1.0; }
  // Its costs can be compared with lengths.
  [[nodiscard]] bool is_in_metres() const {
    return rules_.objective == Objective::length || rules_.objective == Objective::clearance;
  }
  // Straight, the same in both directions; by room and unknown ground to a cell's accuracy.
  [[nodiscard]] double between(const Point& from, const Point& to) const;
  // What a metre counts there, at least min_per_m().
  [[nodiscard]] double per_m_at(const Point& p_map) const;
  // No metre counts less.
  [[nodiscard]] double min_per_m() const { return base_; }

 private:
  const OccupancyGrid& grid_;
  const DiscSpace& space_;
  TravelCostRules rules_;
  double base_ = 1.0;       // of every metre
  double clearance_ = 0.0;  // of what clearance_weight() adds to 1
};

}  // namespace cairn
