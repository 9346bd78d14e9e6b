// What the map lets the transducers hear that say "no echo": the collision monitor, which knows no map, finds the deaf
// ones by it (framework/safety/deaf_transducers.hpp).
//
// An echo is certain of a wall that fills the whole beam, near enough and nearly perpendicular to its axis, where the
// map is certain of it and of the space before it. Of anything else in the middle of the beam it is to be expected, but
// also a good transducer may not hear it.
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/localizer.hpp"
#include "framework/safety/deaf_transducers.hpp"

namespace cairn {

// Of transducer `sensor`; none: nothing can be expected. Some hundred cells are looked at.
[[nodiscard]] std::optional<ExpectedEcho> expected_echo(const OccupancyGrid& grid, const Pose2& T_map_sensor,
                                                        double half_beam_rad, const DeafConfig& config, int sensor);

// Of the readings of cones without echo. The grid is without the observation; the pose is that of it.
[[nodiscard]] std::vector<ExpectedEcho> expected_echoes(const Observation& observation, const OccupancyGrid& grid,
                                                        const PoseEstimate& pose, const DeafConfig& config);

}  // namespace cairn
