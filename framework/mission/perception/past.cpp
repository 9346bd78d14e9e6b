#include "framework/mission/perception/past.hpp"

#include <algorithm>

namespace cairn {
namespace {

bool is_same_place(const RangeReading& a, const RangeReading& b) {
  return a.sensor == b.sensor && a.T_robot_sensor == b.T_robot_sensor && a.half_beam_rad == b.half_beam_rad &&
         a.min_m == b.min_m && a.max_m == b.max_m;
}

}  // namespace

void Past::add(const Observation& observation, const Pose2& T_map_robot) {
  poses_.push_back({observation.recorded_s.value_or(observation.stamp_s), T_map_robot});
  if (!has_observations_) return;
  if (readings_.empty() || !std::ranges::equal(readings_.back(), observation.ranges, is_same_place))
    readings_.push_back(observation.ranges);
  scans_.push_back({observation.stamp_s, readings_.size() - 1, ranges_m_.size()});
  for (const RangeReading& reading : observation.ranges) ranges_m_.push_back(static_cast<float>(reading.range_m));
}

void Past::correct(const std::vector<Pose2>& T_map_robot) {
  for (std::size_t i = 0; i < poses_.size(); ++i) poses_[i].T_map_robot = T_map_robot[i];
}

double Past::moved_m(const std::vector<Pose2>& T_map_robot) const {
  double longest_m = 0.0;
  for (std::size_t i = 0; i < poses_.size(); ++i)
    longest_m = std::max(longest_m, (poses_[i].T_map_robot.position() - T_map_robot[i].position()).norm());
  return longest_m;
}

Observation Past::observation(std::size_t i) const {
  const Scan& scan = scans_[i];
  Observation seen;
  seen.stamp_s = scan.stamp_s;
  seen.ranges = readings_[scan.readings];
  for (std::size_t k = 0; k < seen.ranges.size(); ++k)
    seen.ranges[k].range_m = static_cast<double>(ranges_m_[scan.first_range + k]);
  return seen;
}

}  // namespace cairn
