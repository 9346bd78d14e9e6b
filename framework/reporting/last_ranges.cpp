#include "framework/reporting/last_ranges.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr std::size_t kMaxSonars = 32;
constexpr double kShown_s = 1.0;

}  // namespace

bool LastRanges::fire_in_turn(const Observation& observation) {
  return observation.ranges.size() <= kMaxSonars;
}

void LastRanges::note(const WorldView& world) {
  if (world.observation == nullptr) return;
  const std::vector<RangeReading>& ranges = world.observation->ranges;
  const bool is_all = !fire_in_turn(*world.observation);
  std::erase_if(ranges_, [&](const ShownRange& old) {
    return is_all || old.time_s < world.time_s - kShown_s ||
           std::ranges::any_of(ranges, [&](const RangeReading& now) { return now.sensor == old.reading.sensor; });
  });
  const std::size_t every = (ranges.size() + max_ - 1) / max_;
  for (std::size_t i = 0; i < ranges.size(); i += every)
    ranges_.push_back({world.time_s, world.pose.T_map_robot * ranges[i].T_robot_sensor, ranges[i]});
}

}  // namespace cairn
