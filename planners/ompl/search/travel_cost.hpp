// What a route on the grid is counted by: length, time, room, or all of them weighted.
#pragma once

#include <cstdint>

#include "planners/common/disc_space/driving_time.hpp"

namespace cairn {

// Added to the seed of an informed sampler: apart from the numbers of the plain samplers.
inline constexpr std::uint64_t kInformedStream = 0x1000;

enum class Objective : std::uint8_t {
  as_driven,  // time where the robot is known, else length; the request's cost where it asks for another than length
  as_asked,   // the request's cost
  length,     // metres
  time,       // seconds by the speed law; at the robot's greatest speed where the law is not known
  clearance,  // metres, counted up to five times where there is little room, as on the landmark graph
  weighted,   // metres + seconds + what clearance adds to the metres, each with its weight
};

struct TravelCostRules {
  Objective objective = Objective::length;  // neither of the first two, which depend on the request
  double length_weight = 1.0;               // of `weighted`
  double time_weight = 1.0;
  double clearance_weight = 1.0;
  double unknown_weight = 1.0;  // what a metre over unknown ground counts, at least 1
  double speed_mps = 0.4;
  double radius_m = 0.0;
  std::optional<DrivingRules> driving{};  // none: always at speed_mps
};

// Borrows the grid and the space. Thread-safe.
class TravelCost {
 public:
  TravelCost(const OccupancyGrid& grid, const DiscSpace& space, const TravelCostRules& rules);

  // Nothing but the length counts.
  [[nodiscard]] bool is_length() const { return rules_.objective == Objective::length && rules_.unknown_weight <= 1.0; }
  // Seconds by the speed law.
  [[nodiscard]] bool is_driving_time() const { return rules_.objective == Objective::time && rules_.driving; }
  // Its costs can be compared with lengths.
  [[nodiscard]] bool is_in_metres() const {
    return rules_.objective == Objective::length || rules_.objective == Objective::clearance;
  }
  [[nodiscard]] const std::optional<DrivingRules>& driving() const { return rules_.driving; }
  // Straight, the same in both directions; by room and unknown ground to a cell's accuracy.
  [[nodiscard]] double between(const Point& from, const Point& to) const;
  // The same, or +inf where the robot would certainly stand in something: known sooner.
  [[nodiscard]] double between_or_blocked(const Point& from, const Point& to) const;
  // What a metre counts there, at least min_per_m().
  [[nodiscard]] double per_m_at(const Point& p_map) const;
  // No metre counts less.
  [[nodiscard]] double min_per_m() const { return base_; }

 private:
  // Neither room nor unknown ground.
  [[nodiscard]] bool is_only_time() const { return is_driving_time() && rules_.unknown_weight <= 1.0; }

  const OccupancyGrid& grid_;
  const DiscSpace& space_;
  TravelCostRules rules_;
  double base_ = 1.0;       // of every metre
  double clearance_ = 0.0;  // of what clearance_weight() adds to 1
  double time_ = 0.0;       // of what the speed law adds to the time of a metre in the open
};

}  // namespace cairn
