// Sonar readings derived from a laser's scan: the nearest echo in a sonar's cone. No real sonar answers so
// (plugins/sonar_from_laser/sonar_from_laser.hpp); call results derived.
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"

namespace cairn::log_common {

// What one sonar would have read; nothing when no beam is in its cone.
[[nodiscard]] std::optional<double> derived_range(const SonarModel& sonar, const std::vector<RangeReading>& beams);

// So many sonars at the laser's place, spread evenly over its field; none when it has no beams.
[[nodiscard]] std::vector<SonarModel> ring_for(const std::vector<RangeReading>& beams, int count, double half_beam_rad,
                                               double max_m);

}  // namespace cairn::log_common
