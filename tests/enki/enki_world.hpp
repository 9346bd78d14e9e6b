// The world of a mission in Enki, and in it the robot of that mission with its ring of sonars. Programs that are linked
// with it are linked with Enki, and so are under the GNU General Public License, version 2 or later; with Fast DDS
// (Apache License 2.0) version 3.
#pragma once

#include <filesystem>
#include <memory>

#include "framework/mission/mission.hpp"
#include "tests/plugins/p2os_robot/pioneer_body.hpp"

namespace cairn::enki {

// Stands where the mission starts; its seed is that of the wheels' noise. The outer walls are the world's bounds.
// Throws std::invalid_argument when the mission has no world, or one with what Enki has not: walls inside, doors,
// movers, outlines of which a corner points inwards. log gets a line a tenth of a second, in the map frame:
// monotonic_s,x_m,y_m,angle_deg,v_mps,touches
[[nodiscard]] std::unique_ptr<p2os_robot::PioneerBody> robot_in_its_world(const Mission& mission,
                                                                          const std::filesystem::path& log);

}  // namespace cairn::enki
