// The readings that are shown to people. Sonars fire in turn: the others' last readings count for a second.
#pragma once

#include <vector>

#include "framework/contracts/world_view.hpp"

namespace cairn {

// Where the transducer was then, too.
struct ShownRange {
  double time_s = 0.0;
  Pose2 T_map_sensor;
  RangeReading reading;
};

class LastRanges {
 public:
  // max: of one observation, evenly chosen.
  explicit LastRanges(std::size_t max) : max_(max) {}

  void note(const WorldView& world);
  // Of more transducers than that nothing is kept from earlier: it is a laser, which sees all at once.
  [[nodiscard]] static bool fire_in_turn(const Observation& observation);
  void clear() { ranges_.clear(); }
  [[nodiscard]] const std::vector<ShownRange>& ranges() const { return ranges_; }

 private:
  std::size_t max_;
  std::vector<ShownRange> ranges_;
};

}  // namespace cairn
